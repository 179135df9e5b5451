#include "app/cli/options.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdio>
#include <functional>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

/// The number that the whole text is.
template <class Number>
std::optional<Number> number_from(std::string_view text) {
    Number value{};
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
    return value;
}

std::string one_of(std::span<const char* const> names) {
    std::string text;
    for (const char* name : names) text += (text.empty() ? "" : "|") + std::string(name);
    return text;
}

std::optional<Vec3> vec3_from(std::string_view text) {
    Vec3 value(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const size_t comma = axis < 2 ? text.find(',') : text.size();
        if (comma == std::string_view::npos) return std::nullopt;
        const std::optional<float> number = number_from<float>(text.substr(0, comma));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        value[axis] = *number;
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return value;
}

std::optional<PixelSize> size_from(std::string_view text) {
    constexpr int kLargest = 16384;
    const size_t cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const std::optional<int> width = number_from<int>(text.substr(0, cross));
    const std::optional<int> height = number_from<int>(text.substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > kLargest || *height > kLargest)
        return std::nullopt;
    return PixelSize{*width, *height};
}

}  // namespace

std::string shortest(double value) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

struct Options::Impl {
    Impl(const std::string& command, const std::string& description)
        : app(description, command.empty() ? "boxwood" : "boxwood " + command) {}

    /// An option whose text `set` takes over; where it returns false, `expected` tells what it takes.
    CLI::Option* add(const char* names, const std::string& placeholder, const std::string& expected,
                     const char* help, const std::function<bool(const std::string&)>& set) {
        const auto callback = [=](const CLI::results_t& results) {
            if (set(results.back())) return true;
            throw Error(ExitCode::WrongUsage,
                        std::string(names) + ": \"" + to_utf8(results.back()) + "\", expected " + expected);
        };
        CLI::Option* option = app.add_option(names, callback, help);
        option->type_name(placeholder)->type_size(1)->expected(1);
        return option;
    }
    /// What one could have typed in place of an option that is not there.
    std::vector<std::string> option_names() const {
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options()) {
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
            for (const std::string& name : option->get_snames()) names.push_back("-" + name);
        }
        return names;
    }
    [[noreturn]] void refuse(const std::string& sentence) const {
        throw Error(ExitCode::WrongUsage, sentence + " (see " + app.get_name() + " --help)");
    }

    CLI::App app;
};

Options::Options(const std::string& name, const std::string& description)
    : impl_(std::make_unique<Impl>(name, description)) {
    impl_->app.set_help_flag("-h,--help", "this text");
    impl_->app.get_formatter()->column_width(34);
    impl_->app.allow_extras();
}
Options::~Options() = default;

void Options::argument(const char* name, std::string& value, bool required, const char* help) {
    impl_->app.add_option(name, value, help)->type_name("")->required(required);
}
void Options::arguments(const char* name, std::vector<std::string>& values, const char* help) {
    impl_->app.add_option(name, values, help)->type_name("")->required();
}
void Options::text(const char* names, const char* placeholder, std::string& value, const char* help) {
    impl_->app.add_option(names, value, help)->type_name(placeholder);
}
void Options::required_text(const char* names, const char* placeholder, std::string& value,
                            const char* help) {
    impl_->app.add_option(names, value, help)->type_name(placeholder)->required();
}
void Options::texts(const char* names, const char* placeholder, std::vector<std::string>& values,
                    const char* help) {
    impl_->app.add_option(names, values, help)->type_name(placeholder)->type_size(1)->expected(1)->take_all();
}
void Options::flag(const char* names, bool& value, const char* help) {
    impl_->app.add_flag(names, value, help);
}
void Options::integer(const char* names, int& value, int lower, int upper, const char* help) {
    const std::string expected =
        "a whole number from " + std::to_string(lower) + " to " + std::to_string(upper);
    impl_->add(names, "N", expected, help, [&value, lower, upper](const std::string& text) {
        const std::optional<int> number = number_from<int>(text);
        if (!number || *number < lower || *number > upper) return false;
        value = *number;
        return true;
    });
}
void Options::real(const char* names, double& value, double lower, double upper, const char* help) {
    const std::string expected = "a number from " + shortest(lower) + " to " + shortest(upper);
    impl_->add(names, "NUMBER", expected, help, [&value, lower, upper](const std::string& text) {
        const std::optional<double> number = number_from<double>(text);
        if (!number || !(*number >= lower && *number <= upper)) return false;
        value = *number;
        return true;
    });
}
void Options::vec3(const char* names, std::optional<Vec3>& value, const char* help) {
    impl_->add(names, "X,Y,Z", "three numbers X,Y,Z", help, [&value](const std::string& text) {
        const std::optional<Vec3> vector = vec3_from(text);
        if (vector) value = vector;
        return vector.has_value();
    });
}
void Options::size(const char* names, PixelSize& value, const char* help) {
    impl_->add(names, "WxH", "WxH in pixels, such as 1280x720", help, [&value](const std::string& text) {
        const std::optional<PixelSize> parsed = size_from(text);
        if (parsed) value = *parsed;
        return parsed.has_value();
    });
}
void Options::choice(const char* names, size_t& index, std::span<const char* const> choices,
                     const char* help) {
    const std::vector<std::string> words(choices.begin(), choices.end());
    const std::string first_name = names;
    impl_->add(names, one_of(choices), "", help, [&index, words, first_name](const std::string& text) {
        const auto found = std::ranges::find(words, text);
        if (found == words.end())
            throw Error(ExitCode::WrongUsage, first_name + ": there is no \"" + to_utf8(text) +
                                                  "\"; did you mean " + nearest_word(text, words) + "?");
        index = static_cast<size_t>(found - words.begin());
        return true;
    });
}
void Options::footer(const std::string& text) { impl_->app.footer(text); }

bool Options::parse(std::span<const std::string> args) {
    std::vector<std::string> reversed(args.rbegin(), args.rend());  // as CLI11 wants them
    try {
        impl_->app.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        std::fputs(impl_->app.help().c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& error) {
        impl_->refuse(to_utf8(error.what()));
    }
    for (const std::string& extra : impl_->app.remaining()) {
        if (extra.starts_with("-") && extra != "-")
            impl_->refuse("there is no option " + to_utf8(extra) + "; did you mean " +
                          nearest_word(extra.substr(0, extra.find('=')), impl_->option_names()) + "?");
        impl_->refuse("one argument too many: \"" + to_utf8(extra) + "\"");
    }
    return true;
}

bool Options::given(const char* name) const { return impl_->app.count(name) > 0; }

}  // namespace boxwood
