#include "app/viewer/settings.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/viewer/number_text.h"

namespace boxwood {
namespace {

TEST(Settings, ComeBackAsTheyWereSaved) {
    const std::string folder = testing::TempDir() + "boxwood_settings_test";
    const std::string path = folder + "/deep/settings.json";
    Settings settings;
    settings.interface_scale = 1.5f;
    settings.add_recent("/a.glb");
    settings.add_recent("/b.glb");
    settings.add_recent("/a.glb");
    EXPECT_EQ(settings.recent, (std::vector<std::string>{"/a.glb", "/b.glb"}));
    ASSERT_TRUE(save_settings(settings, path));
    EXPECT_EQ(load_settings(path), settings);
    for (const char* text : {"", "[1", "{\"recent\": 3, \"scale\": \"x\"}", "{\"scale\": 1e300}"}) {
        std::ofstream(path) << text;
        EXPECT_EQ(load_settings(path), Settings{}) << text;
    }
    std::filesystem::remove_all(folder);
    EXPECT_EQ(load_settings(path), Settings{});
}

TEST(Settings, KeepTheLastTenFiles) {
    Settings settings;
    for (int i = 0; i < 30; ++i) settings.add_recent("/" + std::to_string(i));
    ASSERT_EQ(settings.recent.size(), Settings::kMaxRecent);
    EXPECT_EQ(settings.recent.front(), "/29");
}

TEST(Settings, LieInTheUsersConfigurationFolder) {
    setenv("XDG_CONFIG_HOME", "/somewhere", 1);
    EXPECT_EQ(settings_path(), "/somewhere/boxwood/settings.json");
    unsetenv("XDG_CONFIG_HOME");
    setenv("HOME", "/home/me", 1);
    EXPECT_EQ(settings_path(), "/home/me/.config/boxwood/settings.json");
}

TEST(NumberText, SaysNumbersForPeople) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(3100000), "3,100,000");
    EXPECT_EQ(byte_text(512), "512 bytes");
    EXPECT_EQ(byte_text(1536), "1.50 KiB");
    EXPECT_EQ(byte_text(size_t{3} << 30), "3.00 GiB");
    EXPECT_EQ(time_text(0.44), "0.4 ms");
    EXPECT_EQ(time_text(320.2), "320 ms");
    EXPECT_EQ(time_text(1250.0), "1.25 s");
    EXPECT_EQ(rate_text(2355000.0), "2.35 M");
    EXPECT_EQ(percent_text(0.0, 5.0), "0 %");
    EXPECT_EQ(percent_text(1.0, 0.0), "0 %");
    EXPECT_EQ(percent_text(1.0, 8.0), "12.5 %");
    EXPECT_EQ(percent_text(1.0, 1e6), "< 0.01 %");
}

}  // namespace
}  // namespace boxwood
