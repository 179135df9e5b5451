#include "core/catalog/param_text.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

constexpr double kLargestExponent = 40.0;  ///< of the relative area limit S / 2^s

template <class Number>
std::string shortest(Number value) {
    char text[64];
    const std::to_chars_result result = std::to_chars(text, text + sizeof(text), value);
    return std::string(text, result.ptr);
}

template <class Number>
std::optional<Number> number_from(const std::string& text) {
    Number value{};
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
    return value;
}

/// "a, b or c"
std::string one_of(std::span<const char* const> names) {
    std::string text;
    for (size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

ParamText text_of(const char* relative_key, const char* absolute_key, const AreaLimit& limit) {
    return {limit.absolute ? absolute_key : relative_key, shortest(limit.value)};
}

/// Collects keys and values.
class TextReader final : public ParamVisitor {
public:
    std::vector<ParamText> texts;

    void on_int(const char* key, int& value, int, int, const char*) override {
        texts.push_back({key, shortest(value)});
    }
    void on_float(const char* key, float& value, float, float, const char*) override {
        texts.push_back({key, shortest(value)});
    }
    void on_bool(const char* key, bool& value, const char*) override {
        texts.push_back({key, value ? "on" : "off"});
    }
    void on_enum(const char* key, int& value, std::span<const char* const> names, const char*) override {
        texts.push_back({key, names[static_cast<size_t>(value)]});
    }
    void on_area_limit(const char* relative_key, const char* absolute_key, AreaLimit& value,
                       const char*) override {
        texts.push_back(text_of(relative_key, absolute_key, value));
    }
};

/// Collects what help shows.
class InfoReader final : public ParamVisitor {
public:
    std::vector<ParamInfo> infos;

    void on_int(const char* key, int& value, int lower, int upper, const char* help) override {
        add({key}, "int", shortest(lower) + " to " + shortest(upper), {key, shortest(value)}, help);
    }
    void on_float(const char* key, float& value, float lower, float upper, const char* help) override {
        add({key}, "float", shortest(lower) + " to " + shortest(upper), {key, shortest(value)}, help);
    }
    void on_bool(const char* key, bool& value, const char* help) override {
        add({key}, "bool", "on or off", {key, value ? "on" : "off"}, help);
    }
    void on_enum(const char* key, int& value, std::span<const char* const> names, const char* help) override {
        add({key}, "enum", one_of(names), {key, names[static_cast<size_t>(value)]}, help);
    }
    void on_area_limit(const char* relative_key, const char* absolute_key, AreaLimit& value,
                       const char* help) override {
        const std::string range = std::string(relative_key) + ": 0 to " + shortest(kLargestExponent) +
                                  ", or " + absolute_key + ": above 0";
        add({relative_key, absolute_key}, "area limit", range, text_of(relative_key, absolute_key, value),
            help);
    }

private:
    void add(std::vector<std::string> keys, const char* kind, const std::string& range,
             const ParamText& initial, const char* help) {
        infos.push_back({std::move(keys), kind, range, initial.key + "=" + initial.value, help});
    }
};

/// Sets what is given.
class Setter final : public ParamVisitor {
public:
    Setter(const std::string& stage, std::span<const ParamText> given) : stage_(stage), given_(given) {}

    void on_int(const char* key, int& value, int lower, int upper, const char*) override {
        if (const std::string* text = find(key))
            value = in_range<int>(key, *text, lower, upper, "a whole number");
    }
    void on_float(const char* key, float& value, float lower, float upper, const char*) override {
        if (const std::string* text = find(key))
            value = in_range<float>(key, *text, lower, upper, "a number");
    }
    void on_bool(const char* key, bool& value, const char*) override {
        const std::string* text = find(key);
        if (!text) return;
        if (*text != "on" && *text != "off") refuse(key, *text, "on or off");
        value = *text == "on";
    }
    void on_enum(const char* key, int& value, std::span<const char* const> names, const char*) override {
        const std::string* text = find(key);
        if (!text) return;
        const auto found = std::find(names.begin(), names.end(), *text);
        if (found == names.end()) {
            const std::string nearest = nearest_word(*text, {names.begin(), names.end()});
            refuse(key, *text, one_of(names) + "; did you mean " + nearest + "?");
        }
        value = static_cast<int>(found - names.begin());
    }
    void on_area_limit(const char* relative_key, const char* absolute_key, AreaLimit& value,
                       const char*) override {
        const std::string* relative = find(relative_key);
        const std::string* absolute = find(absolute_key);
        if (relative && absolute)
            throw Error(ExitCode::WrongUsage, std::string(relative_key) + " and " + absolute_key + " of " +
                                                  stage_ + " say the same thing: give one of them");
        if (relative) value = {false, in_range(relative_key, *relative, 0.0, kLargestExponent, "a number")};
        if (absolute) {
            const std::optional<double> area = number_from<double>(*absolute);
            if (!area || !(*area > 0.0 && *area <= std::numeric_limits<double>::max()))
                refuse(absolute_key, *absolute, "an area above 0 in square world units");
            value = {true, *area};
        }
    }

    /// Throws for a key that no parameter has asked for.
    void check_all_used() const {
        for (size_t i = 0; i < given_.size(); ++i) {
            const std::string& key = given_[i].key;
            for (size_t j = 0; j < i; ++j)
                if (given_[j].key == key)
                    throw Error(ExitCode::WrongUsage, key + " of " + stage_ + " is given twice");
            if (std::ranges::find(keys_, key) != keys_.end()) continue;
            std::string message = stage_ + " has no parameter \"" + to_utf8(key) + "\"";
            message += keys_.empty() ? ": it has none" : "; did you mean " + nearest_word(key, keys_) + "?";
            throw Error(ExitCode::WrongUsage, message);
        }
    }

private:
    /// The text given for the key, or nullptr.
    const std::string* find(const char* key) {
        keys_.push_back(key);
        const auto found = std::ranges::find(given_, key, &ParamText::key);
        return found == given_.end() ? nullptr : &found->value;
    }
    [[noreturn]] void refuse(const std::string& key, const std::string& text,
                             const std::string& expected) const {
        throw Error(ExitCode::WrongUsage,
                    key + " of " + stage_ + " is \"" + to_utf8(text) + "\", expected " + expected);
    }
    template <class Number>
    Number in_range(const char* key, const std::string& text, Number lower, Number upper,
                    const char* what) const {
        const std::optional<Number> value = number_from<Number>(text);
        if (!value || !(*value >= lower && *value <= upper))
            refuse(key, text, std::string(what) + " from " + shortest(lower) + " to " + shortest(upper));
        return *value + Number{0};  // -0 becomes 0: one value, one text
    }

    const std::string& stage_;
    std::span<const ParamText> given_;
    std::vector<std::string> keys_;
};

}  // namespace

void set_params(StageMethod& method, const std::string& stage, std::span<const ParamText> given) {
    Setter setter(stage, given);
    method.describe(setter);
    setter.check_all_used();
}

std::vector<ParamText> param_texts(const StageMethod& method) {
    TextReader reader;
    method.clone()->describe(reader);
    return std::move(reader.texts);
}

std::vector<ParamInfo> param_infos(const StageMethod& method) {
    InfoReader reader;
    method.clone()->describe(reader);
    return std::move(reader.infos);
}

}  // namespace boxwood
