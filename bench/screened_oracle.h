#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/scene/mesh.h"
#include "oracle/oracle.h"

namespace boxwood::bench {

/// oracle::closest_hit for meshes of many triangles: a screen in double drops what is clearly not hit,
/// rational arithmetic decides all the rest.
///
/// It is an oracle still: the screen's margins are more than 100 times the worst rounding error of its own
/// arithmetic (derived at each test), so it drops nothing that rational arithmetic would take; and it shares
/// no code with the tests and structures that are judged by it.
class ScreenedOracle {
public:
    explicit ScreenedOracle(const Mesh& mesh);

    /// Smallest t, of equal ones the lowest primitive. The ray is valid (see is_valid).
    std::optional<oracle::ExactHit> closest_hit(const Ray& ray) const;

private:
    static constexpr uint32_t kBlock = 64;  ///< consecutive triangles under one box

    const Mesh& mesh_;
    std::vector<Box> blocks_;
};

/// closest_hit of each ray, on all threads; not valid ones miss.
std::vector<std::optional<oracle::ExactHit>> closest_hits(const ScreenedOracle& oracle,
                                                          std::span<const Ray> rays);

}  // namespace boxwood::bench
