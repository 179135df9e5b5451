#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"

namespace boxwood {

/// Width and height in pixels.
struct PixelSize {
    int width = 1280;
    int height = 720;
};

/// The number in the shortest form that reads back as the same.
std::string shortest(double value);

/// The options of one command: each is bound to a variable that keeps its value where the option is not
/// given. Names as CLI11 takes them: "-o,--output". Lives as long as the variables.
class Options {
public:
    /// `name` as typed after "boxwood"; `description`: sentences for the head of the help.
    Options(const std::string& name, const std::string& description);
    ~Options();
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;

    /// An argument without a dash.
    void argument(const char* name, std::string& value, bool required, const char* help);
    /// One or more arguments without a dash.
    void arguments(const char* name, std::vector<std::string>& values, const char* help);
    /// `placeholder`: the word for the value in the help, such as "FILE".
    void text(const char* names, const char* placeholder, std::string& value, const char* help);
    void required_text(const char* names, const char* placeholder, std::string& value, const char* help);
    /// May be given several times; each time one value.
    void texts(const char* names, const char* placeholder, std::vector<std::string>& values,
               const char* help);
    void flag(const char* names, bool& value, const char* help);
    /// A whole number from lower to upper.
    void integer(const char* names, int& value, int lower, int upper, const char* help);
    void real(const char* names, double& value, double lower, double upper, const char* help);
    /// X,Y,Z
    void vec3(const char* names, std::optional<Vec3>& value, const char* help);
    /// WxH, each from 1 to 16384.
    void size(const char* names, PixelSize& value, const char* help);
    /// One of the names; `index` is its place.
    void choice(const char* names, size_t& index, std::span<const char* const> choices, const char* help);
    /// Text under the options in the help.
    void footer(const std::string& text);

    /// Sets the variables. False if help was asked for and has been printed. Throws Error (WrongUsage) that
    /// says what is wrong and names the nearest valid word.
    bool parse(std::span<const std::string> args);
    /// Whether the option was given, by one of its names.
    bool given(const char* name) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace boxwood
