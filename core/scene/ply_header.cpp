#include "core/scene/ply_header.h"

#include <charconv>
#include <optional>
#include <string_view>

namespace boxwood {
namespace {

constexpr size_t kLongestLine = 1 << 16;

std::vector<std::string_view> split_words(std::string_view line) {
    std::vector<std::string_view> words;
    for (size_t at = 0; at < line.size();) {
        const size_t begin = line.find_first_not_of(" \t", at);
        if (begin == std::string_view::npos) break;
        const size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        at = end;
    }
    return words;
}

std::optional<PlyType> parse_type(std::string_view word) {
    if (word == "char" || word == "int8") return PlyType::Int8;
    if (word == "uchar" || word == "uint8") return PlyType::UInt8;
    if (word == "short" || word == "int16") return PlyType::Int16;
    if (word == "ushort" || word == "uint16") return PlyType::UInt16;
    if (word == "int" || word == "int32") return PlyType::Int32;
    if (word == "uint" || word == "uint32") return PlyType::UInt32;
    if (word == "float" || word == "float32") return PlyType::Float;
    if (word == "double" || word == "float64") return PlyType::Double;
    return std::nullopt;
}

class HeaderParser {
public:
    explicit HeaderParser(const InputFile& file) : file_(file) {}

    PlyHeader parse() {
        if (next_line() != "ply") file_.fail_at_line(1, "expected the word ply");
        while (true) {
            const std::string_view line = next_line();
            const std::vector<std::string_view> words = split_words(line);
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header") break;
            if (words[0] == "format") {
                parse_format(words);
            } else if (words[0] == "element") {
                parse_element(words);
            } else if (words[0] == "property") {
                parse_property(words);
            } else {
                file_.fail_at_line(line_, "found " + in_quotes(line) +
                                              ", expected format, element, property, comment or end_header");
            }
        }
        if (!has_format_) file_.fail("the header has no format line");
        header_.body = at_;
        header_.body_line = line_ + 1;
        return header_;
    }

private:
    /// Without its end: LF, CR LF, or CR alone.
    std::string_view next_line() {
        const std::string_view rest = std::string_view(file_.bytes).substr(at_, kLongestLine);
        const size_t end = rest.find_first_of("\r\n");
        if (end == std::string_view::npos)
            file_.fail_at_line(line_ + 1, "the header does not end, expected end_header");
        const bool is_pair = rest[end] == '\r' && end + 1 < rest.size() && rest[end + 1] == '\n';
        at_ += end + (is_pair ? 2 : 1);
        ++line_;
        return rest.substr(0, end);
    }
    void parse_format(const std::vector<std::string_view>& words) {
        const std::string_view name = words.size() > 1 ? words[1] : "";
        if (name == "ascii") {
            header_.format = PlyFormat::Ascii;
        } else if (name == "binary_little_endian") {
            header_.format = PlyFormat::LittleEndian;
        } else if (name == "binary_big_endian") {
            header_.format = PlyFormat::BigEndian;
        } else {
            file_.fail_at_line(line_, "format " + in_quotes(name) +
                                          ", expected ascii, binary_little_endian or binary_big_endian");
        }
        has_format_ = true;
    }
    void parse_element(const std::vector<std::string_view>& words) {
        PlyElement element;
        if (words.size() != 3) file_.fail_at_line(line_, "expected: element NAME COUNT");
        element.name = words[1];
        const char* end = words[2].data() + words[2].size();
        const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
        if (error != std::errc() || stop != end)
            file_.fail_at_line(line_,
                               "element count " + in_quotes(words[2]) + ", expected a whole number from 0");
        header_.elements.push_back(element);
    }
    void parse_property(const std::vector<std::string_view>& words) {
        if (header_.elements.empty()) file_.fail_at_line(line_, "a property before the first element");
        const bool is_list = words.size() > 1 && words[1] == "list";
        if (words.size() != (is_list ? 5u : 3u))
            file_.fail_at_line(line_, "expected: property TYPE NAME, or property list TYPE TYPE NAME");
        PlyProperty property;
        property.is_list = is_list;
        property.name = words.back();
        property.type = parse_known_type(words[words.size() - 2]);
        if (is_list) property.count_type = parse_known_type(words[2]);
        header_.elements.back().properties.push_back(property);
    }
    PlyType parse_known_type(std::string_view word) const {
        const std::optional<PlyType> type = parse_type(word);
        if (!type) file_.fail_at_line(line_, "unknown type " + in_quotes(word));
        return *type;
    }

    const InputFile& file_;
    PlyHeader header_;
    size_t at_ = 0;
    uint64_t line_ = 0;
    bool has_format_ = false;
};

}  // namespace

size_t ply_type_size(PlyType type) {
    switch (type) {
        case PlyType::Int8:
        case PlyType::UInt8:
            return 1;
        case PlyType::Int16:
        case PlyType::UInt16:
            return 2;
        case PlyType::Int32:
        case PlyType::UInt32:
        case PlyType::Float:
            return 4;
        case PlyType::Double:
            break;
    }
    return 8;
}

PlyHeader parse_ply_header(const InputFile& file) { return HeaderParser(file).parse(); }

}  // namespace boxwood
