#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

/// The default values of a stage's parameters, as text and number.
class Defaults final : public ParamVisitor {
public:
    explicit Defaults(const CatalogEntry& entry) { Stage(entry).method().describe(*this); }
    void on_int(const char* key, int& value, int, int, const char*) override { ints[key] = value; }
    void on_float(const char* key, float& value, float, float, const char*) override { floats[key] = value; }
    void on_bool(const char* key, bool& value, const char*) override { ints[key] = value ? 1 : 0; }
    void on_enum(const char* key, int& value, std::span<const char* const>, const char*) override {
        ints[key] = value;
    }
    void on_area_limit(const char* key, const char*, AreaLimit& value, const char*) override {
        limits[key] = value;
    }

    std::map<std::string, int> ints;
    std::map<std::string, float> floats;
    std::map<std::string, AreaLimit> limits;
};

/// What a threshold means in this scene.
std::string scene_numbers(const std::string& stage, const std::string& key, double value, const Box& bounds) {
    if (bounds.is_empty() || stage != "evh" || key != "t") return {};
    const double volume = bounds.volume();
    return "\nV / 2^t = " + number_text(volume) + " / 2^" + number_text(value) + " = " +
           number_text(volume * std::exp2(-value)) + " cubic world units.";
}

/// A widget for each parameter.
class Widgets final : public ParamVisitor {
public:
    Widgets(const Context& context, const CatalogEntry& entry)
        : context_(context), stage_(entry.id), defaults_(entry) {}

    void on_int(const char* key, int& value, int lower, int upper, const char* help) override {
        const int usual = defaults_.ints[key];
        begin(key, value != usual);
        const bool wide = upper - lower > 1000;
        changed_ |=
            ImGui::SliderInt("##value", &value, lower, upper, "%d",
                             ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0));
        end(key, value, usual,
            range_text(lower, upper) + scene_numbers(stage_, key, value, context_.input.scene_bounds), help);
    }
    void on_float(const char* key, float& value, float lower, float upper, const char* help) override {
        const float usual = defaults_.floats[key];
        begin(key, value != usual);
        changed_ |= ImGui::SliderFloat("##value", &value, lower, upper, "%.4g", ImGuiSliderFlags_AlwaysClamp);
        const double v = static_cast<double>(value);
        end(key, value, usual,
            range_text(static_cast<double>(lower), static_cast<double>(upper)) +
                scene_numbers(stage_, key, v, context_.input.scene_bounds),
            help);
    }
    void on_bool(const char* key, bool& value, const char* help) override {
        bool usual = defaults_.ints[key] != 0;
        begin(key, value != usual);
        changed_ |= ImGui::Checkbox("##value", &value);
        end(key, value, usual, "", help);
    }
    void on_enum(const char* key, int& value, std::span<const char* const> names, const char* help) override {
        const int usual = defaults_.ints[key];
        begin(key, value != usual);
        changed_ |= ImGui::Combo("##value", &value, names.data(), static_cast<int>(names.size()));
        end(key, value, usual, "", help);
    }
    void on_area_limit(const char* relative_key, const char* absolute_key, AreaLimit& value,
                       const char* help) override {
        const AreaLimit usual = defaults_.limits[relative_key];
        const double area = context_.input.scene_bounds.surface_area();
        begin(value.absolute ? absolute_key : relative_key, value != usual, /*with_switch=*/true);
        float number = static_cast<float>(value.value);
        const float largest = value.absolute ? static_cast<float>(std::clamp(area, 1e-30, 1e30)) : 40.0f;
        const float smallest = value.absolute ? largest * 0x1p-40f : 0.0f;
        const ImGuiSliderFlags flags =
            ImGuiSliderFlags_AlwaysClamp | (value.absolute ? ImGuiSliderFlags_Logarithmic : 0);
        if (ImGui::SliderFloat("##value", &number, smallest, largest, "%.4g", flags)) {
            value.value = value.absolute ? static_cast<double>(number)
                                         : std::round(static_cast<double>(number) * 100.0) / 100.0;
            changed_ = true;
        }
        const std::string formula = "SA_max = S / 2^s; here S = " + number_text(area) +
                                    ", SA_max = " + number_text(value.max_area(area)) +
                                    " square world units.";
        end(relative_key, value, usual, formula, help);
        ImGui::SameLine();
        if (ImGui::Button(value.absolute ? "as s" : "as area") && area > 0.0) switch_form(value, area);
        tooltip(context_, value.absolute ? "Gives the limit relative to the scene's box, as s."
                                         : "Gives the limit in square world units.");
        ImGui::PopID();
    }

    bool changed() const { return changed_; }

private:
    static std::string range_text(double lower, double upper) {
        return number_text(lower) + " to " + number_text(upper) + ".";
    }
    /// The same limit, named the other way.
    void switch_form(AreaLimit& value, double area) {
        const double limit = value.max_area(area);
        value.absolute = !value.absolute;
        value.value = value.absolute
                          ? limit
                          : std::clamp(std::round(100.0 * std::log2(area / limit)) / 100.0, 0.0, 40.0);
        changed_ = true;
    }
    void begin(const char* key, bool is_changed, bool with_switch = false) {
        ImGui::PushID(key);
        ImGui::AlignTextToFramePadding();
        colored(is_changed ? context_.colors.changed : context_.colors.dim, key);
        const float label = 104.0f * context_.scale;
        ImGui::SameLine(label);
        ImGui::SetNextItemWidth(with_switch ? -62.0f * context_.scale : -1.0f);
        is_changed_ = is_changed;
        with_switch_ = with_switch;
    }
    template <class Value>
    void end(const char* key, Value& value, const Value& usual, const std::string& numbers,
             const char* help) {
        if (put_back() && is_changed_) {
            value = usual;
            changed_ = true;
        }
        std::string text = std::string(key) + ": " + help;
        if (!numbers.empty()) text += "\n" + numbers;
        text += "\nCtrl+click types a value.";
        if (is_changed_) text += " Changed; right click puts it back.";
        tooltip(context_, text);
        if (!with_switch_) ImGui::PopID();
    }

    const Context& context_;
    std::string stage_;
    Defaults defaults_;
    bool changed_ = false, is_changed_ = false, with_switch_ = false;
};

}  // namespace

bool stage_widgets(const Context& context, Stage& stage) {
    Widgets widgets(context, stage.entry());
    stage.method().describe(widgets);
    return widgets.changed();
}

}  // namespace boxwood::panel
