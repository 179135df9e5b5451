#pragma once

#include <string>
#include <vector>

#include "app/viewer/session.h"
#include "core/render/image_compare.h"

namespace boxwood {

/// One session of `boxwood check`, rendered and compared.
struct CheckRow {
    std::string name;  ///< of the files, without .json and .png
    CheckLimits limits;
    std::string problem;  ///< why the session could not be compared; empty: it was
    bool passed = false;
    bool updated = false;  ///< the picture was renewed
    Comparison comparison;
    Image reference, result;  ///< the reference empty where there is none
};

/// What a row says, in a few words.
std::string verdict(const CheckRow& row);

/// A page that stands alone: reference, result and difference of each row side by side, failures first.
std::string check_page(const std::string& folder, const std::vector<CheckRow>& rows);

}  // namespace boxwood
