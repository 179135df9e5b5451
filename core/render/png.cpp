#include "core/render/png.h"

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <png.h>

#include "core/base/assert.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace boxwood {

namespace {

constexpr const char* kSessionKeyword = "boxwood-session";
/// Of a chunk that is not pixels: libpng takes memory for what its length claims, before it reads it.
constexpr uint32_t kMaxChunkBytes = 1u << 24;
constexpr png_uint_32 kMaxSide = 1u << 16;

/// libpng reports an error by a jump back into the function that called it. What must live through the jump
/// is here, owned by the caller of that function, which itself holds nothing that needs a destructor.
struct Codec {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::string message;           ///< what libpng says is wrong
    std::FILE* file = nullptr;     ///< reading
    std::vector<png_bytep> rows;   ///< reading
    PngFile result;                ///< reading
    const Image* image = nullptr;  ///< writing
    std::string text;              ///< writing: the session; empty for none
    std::string bytes;             ///< writing: the file so far
    std::string keyword = kSessionKeyword;
    std::string no_language;
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    static_cast<Codec*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

void append_bytes(png_structp png, png_bytep data, size_t size) {
    static_cast<Codec*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
}
void flush_nothing(png_structp) {}

void read_bytes(png_structp png, png_bytep data, size_t size) {
    if (std::fread(data, 1, size, static_cast<Codec*>(png_get_io_ptr(png))->file) != size)
        png_error(png, "the file ends in the middle of it");
}

/// False where libpng jumped back with an error.
bool encode(Codec& codec) {
    if (setjmp(png_jmpbuf(codec.png)) != 0) return false;
    const Image& image = *codec.image;
    png_set_write_fn(codec.png, &codec, append_bytes, flush_nothing);
    png_set_compression_level(codec.png, 6);
    png_set_IHDR(codec.png, codec.info, static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(codec.png, codec.info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (!codec.text.empty()) {
        png_text text{};
        text.compression = PNG_ITXT_COMPRESSION_zTXt;
        text.key = codec.keyword.data();
        text.text = codec.text.data();
        text.itxt_length = codec.text.size();
        text.lang = codec.no_language.data();
        text.lang_key = codec.no_language.data();
        png_set_text(codec.png, codec.info, &text, 1);
    }
    png_write_info(codec.png, codec.info);
    for (int y = 0; y < image.height; ++y) png_write_row(codec.png, image.pixel(0, y));
    png_write_end(codec.png, codec.info);
    return true;
}

/// Every kind of pixel becomes 8-bit RGBA.
void ask_for_rgba(png_structp png) {
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
}

void find_session(Codec& codec) {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(codec.png, codec.info, &texts, &count);
    for (int i = 0; i < count; ++i) {
        if (std::strcmp(texts[i].key, kSessionKeyword) != 0 || texts[i].text == nullptr) continue;
        const bool international = texts[i].compression >= PNG_ITXT_COMPRESSION_NONE;
        const size_t length = international ? texts[i].itxt_length : texts[i].text_length;
        codec.result.session_text.assign(texts[i].text, length);
        return;
    }
}

/// False where libpng jumped back with an error.
bool decode(Codec& codec) {
    if (setjmp(png_jmpbuf(codec.png)) != 0) return false;
    png_set_read_fn(codec.png, &codec, read_bytes);
    png_set_user_limits(codec.png, kMaxSide, kMaxSide);
    png_set_chunk_malloc_max(codec.png, kMaxChunkBytes);
    png_set_chunk_cache_max(codec.png, 128);
    png_read_info(codec.png, codec.info);
    const size_t width = png_get_image_width(codec.png, codec.info);
    const size_t height = png_get_image_height(codec.png, codec.info);
    if (width * height > kMaxPngPixels) png_error(codec.png, "it has more pixels than are read");
    ask_for_rgba(codec.png);
    png_read_update_info(codec.png, codec.info);
    if (png_get_rowbytes(codec.png, codec.info) != 4 * width)
        png_error(codec.png, "not a kind of pixel known");
    codec.result.image = Image(static_cast<int>(width), static_cast<int>(height));
    for (size_t y = 0; y < height; ++y)
        codec.rows.push_back(codec.result.image.pixel(0, static_cast<int>(y)));
    png_read_image(codec.png, codec.rows.data());
    png_read_end(codec.png, codec.info);
    find_session(codec);
    return true;
}

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error(ExitCode::BadInput, path + ": cannot be read as a PNG picture: " + reason);
}

/// Walks the chunks of a file that is placed behind its signature, and returns there.
void check_chunk_lengths(std::FILE* file, const std::string& path) {
    const long begin = std::ftell(file);
    for (png_byte head[8]; std::fread(head, 1, sizeof head, file) == sizeof head;) {
        const uint32_t length = png_get_uint_32(head);
        const bool pixels = std::memcmp(head + 4, "IDAT", 4) == 0;
        if (!pixels && length > kMaxChunkBytes) fail(path, "a chunk claims to be larger than is read");
        if (std::fseek(file, static_cast<long>(length) + 4, SEEK_CUR) != 0) break;
    }
    std::clearerr(file);
    if (begin < 0 || std::fseek(file, begin, SEEK_SET) != 0) fail(path, "it is not a regular file");
}

}  // namespace

std::string encode_png(const Image& image, const std::string& session_text) {
    BOXWOOD_ASSERT(image.width > 0 && image.height > 0);
    Codec codec;
    codec.image = &image;
    codec.text = session_text;
    codec.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &codec, on_error, on_warning);
    if (codec.png != nullptr) codec.info = png_create_info_struct(codec.png);
    const bool done = codec.info != nullptr && encode(codec);
    png_destroy_write_struct(&codec.png, &codec.info);
    if (!done) throw Error(ExitCode::WrongUsage, "the picture cannot be made a PNG: " + codec.message);
    return std::move(codec.bytes);
}

void write_png(const std::string& path, const Image& image, const std::string& session_text) {
    write_file_atomically(path, encode_png(image, session_text));
}

PngFile read_png(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (file == nullptr) fail(path, std::strerror(errno));
    png_byte signature[8] = {};
    if (std::fread(signature, 1, sizeof signature, file.get()) != sizeof signature ||
        png_sig_cmp(signature, 0, sizeof signature) != 0) {
        fail(path, "it does not begin with a PNG signature");
    }
    check_chunk_lengths(file.get(), path);
    Codec codec;
    codec.file = file.get();
    codec.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &codec, on_error, on_warning);
    if (codec.png != nullptr) {
        codec.info = png_create_info_struct(codec.png);
        png_set_sig_bytes(codec.png, sizeof signature);
    }
    const bool done = codec.info != nullptr && decode(codec);
    png_destroy_read_struct(&codec.png, &codec.info, nullptr);
    if (!done) fail(path, codec.message);
    return std::move(codec.result);
}

bool has_png_signature(std::span<const std::byte> bytes) {
    return bytes.size() >= 8 && png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) == 0;
}

}  // namespace boxwood
