#include "core/base/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "support/temporary_folder.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

class WriteFile : public ::testing::Test {
protected:
    std::string at(const char* name) const { return (folder_ / name).string(); }
    static std::string read(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    size_t file_count() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    TemporaryFolder temporary_;
    fs::path folder_ = temporary_.path();
};

TEST_F(WriteFile, ReplacesTheContentAndLeavesNothingBeside) {
    write_file_atomically(at("a"), "a long old text");
    write_file_atomically(at("a"), std::string_view("x\0y", 3));
    EXPECT_EQ(read(at("a")), std::string("x\0y", 3));
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(WriteFile, IsAnotherFileThanTheOldOneWhichReadersMayStillHold) {
    write_file_atomically(at("a"), "old");
    std::ifstream old(at("a"));
    write_file_atomically(at("a"), "newer");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(old), {}), "old");
}

TEST_F(WriteFile, FollowsASymbolicLink) {
    write_file_atomically(at("real"), "old");
    fs::create_symlink("real", folder_ / "link");
    write_file_atomically(at("link"), "text");
    EXPECT_TRUE(fs::is_symlink(at("link")));
    EXPECT_EQ(read(at("real")), "text");
}

TEST_F(WriteFile, LeavesADeviceInPlace) {
    write_file_atomically("/dev/null", "text");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteFile, NamesTheFileThatCannotBeWritten) {
    for (const std::string& path : {at("no/such/folder"), folder_.string(), std::string()}) {
        for (const bool only_check : {true, false}) {
            try {
                if (only_check) {
                    check_writable(path);
                } else {
                    write_file_atomically(path, "text");
                }
                FAIL() << path;
            } catch (const Error& error) {
                EXPECT_EQ(error.exit_code(), ExitCode::WrongUsage);
                EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
            }
        }
    }
    EXPECT_EQ(file_count(), 0u);
}

}  // namespace
}  // namespace boxwood
