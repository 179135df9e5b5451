#include "app/viewer/clipboard.h"

#include <imgui.h>

namespace boxwood {

std::string clipboard() {
    const char* text = ImGui::GetClipboardText();
    return text != nullptr ? text : "";
}

void set_clipboard(const std::string& text) { ImGui::SetClipboardText(text.c_str()); }

}  // namespace boxwood
