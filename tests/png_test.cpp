#include "core/render/png.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/error.h"

namespace boxwood {
namespace {

/// A file of this test alone, removed at its end.
class TemporaryFile {
public:
    TemporaryFile() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        path_ = testing::TempDir() + "boxwood_png_" + info->name() + ".png";
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& path() const { return path_; }
    void write(const std::string& bytes) const {
        std::filesystem::remove(path_);  // a file that is cut short may be flushed to disk first
        std::ofstream(path_, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }

private:
    std::string path_;
};

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            uint8_t* p = image.pixel(x, y);
            p[0] = static_cast<uint8_t>(x * 3);
            p[1] = static_cast<uint8_t>(y * 5);
            p[2] = static_cast<uint8_t>(x ^ y);
            p[3] = static_cast<uint8_t>(255 - y);
        }
    }
    return image;
}

std::string refusal(const std::string& path) {
    try {
        read_png(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::BadInput);
        return error.what();
    }
    return {};
}

TEST(Png, PixelsAndSessionComeBack) {
    const TemporaryFile file;
    const Image image = gradient(61, 37);
    const std::string session =
        "{\"scene\": \"h\u00fctte.glb\", \"levels\": [0, 3]}\n" + std::string(100000, 'x');
    write_png(file.path(), image, session);
    const PngFile read = read_png(file.path());
    EXPECT_EQ(read.image, image);
    EXPECT_EQ(read.session_text, session);
}

TEST(Png, WithoutSessionItCarriesNone) {
    const TemporaryFile file;
    write_png(file.path(), gradient(1, 1));
    EXPECT_EQ(read_png(file.path()).session_text, "");
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
    EXPECT_EQ(encode_png(gradient(20, 20), "{}"), encode_png(gradient(20, 20), "{}"));
}

TEST(Png, ToAFolderThatIsNotThereIsRefusedByName) {
    try {
        write_png("/no-such-folder/picture.png", gradient(2, 2));
        FAIL() << "was written";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("/no-such-folder/picture.png"), std::string::npos);
    }
}

TEST(Png, AFileThatIsNotThereOrNoPngIsRefusedByName) {
    const TemporaryFile file;
    EXPECT_NE(refusal(file.path()).find(file.path()), std::string::npos);
    file.write("");
    EXPECT_NE(refusal(file.path()).find(file.path()), std::string::npos);
    file.write("{\"version\": 1, \"scene\": \"atrium\"}");
    EXPECT_NE(refusal(file.path()).find("signature"), std::string::npos);
    EXPECT_NE(refusal(testing::TempDir()).find(testing::TempDir()), std::string::npos);
}

TEST(Png, EveryCutIsRefused) {
    const TemporaryFile file;
    const std::string whole = encode_png(gradient(9, 9), "session");
    for (size_t size = 0; size + 12 < whole.size(); ++size) {  // the last 12 bytes, IEND, hold nothing
        file.write(whole.substr(0, size));
        EXPECT_NE(refusal(file.path()).find(file.path()), std::string::npos) << size;
    }
}

TEST(Png, EveryFlippedByteIsReadOrRefused) {
    const TemporaryFile file;
    const std::string whole = encode_png(gradient(9, 9), "session");
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
        file.write(damaged);
        try {
            read_png(file.path());
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::BadInput);
        }
    }
}

/// A header that names a size, with its right checksum, and no pixels.
std::string header_only(uint32_t width, uint32_t height) {
    const auto big_endian = [](uint32_t v) {
        std::string bytes;
        for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(v >> shift & 0xffu);
        return bytes;
    };
    const std::string chunk =
        "IHDR" + big_endian(width) + big_endian(height) + std::string("\x08\x06\0\0\0", 5);
    uint32_t crc = 0xffffffffu;
    for (const char c : chunk) {
        crc ^= static_cast<uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return std::string("\x89PNG\r\n\x1a\n") + big_endian(13) + chunk + big_endian(~crc);
}

TEST(Png, AHugeSizeIsRefusedBeforeMemoryIsTaken) {
    const TemporaryFile file;
    file.write(header_only(65535, 65535) + std::string(100, '\0'));
    EXPECT_NE(refusal(file.path()).find(file.path()), std::string::npos);
    file.write(header_only(0x7fffffffu, 0x7fffffffu));
    EXPECT_NE(refusal(file.path()).find(file.path()), std::string::npos);
    file.write(header_only(0, 10));
    EXPECT_NE(refusal(file.path()).find(file.path()), std::string::npos);
}

TEST(Png, AChunkThatClaimsAGigabyteIsRefusedBeforeMemoryIsTaken) {
    const TemporaryFile file;
    std::string damaged = encode_png(gradient(9, 9), "session");
    const size_t chunk = damaged.find("iTXt");
    ASSERT_NE(chunk, std::string::npos);
    damaged[chunk - 4] = '\x55';
    file.write(damaged);
    EXPECT_NE(refusal(file.path()).find("claims"), std::string::npos);
}

TEST(Png, IsToldByItsSignature) {
    const std::string whole = encode_png(gradient(2, 2));
    EXPECT_TRUE(has_png_signature(std::as_bytes(std::span(whole))));
    EXPECT_FALSE(has_png_signature(std::as_bytes(std::span(whole)).first(7)));
    EXPECT_FALSE(has_png_signature(std::as_bytes(std::span(whole)).subspan(1)));
}

}  // namespace
}  // namespace boxwood
