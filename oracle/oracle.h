#pragma once

#include <gmpxx.h>

#include <optional>

#include "core/base/box.h"
#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood::oracle {

/// Rational arithmetic (GMP) on the input floats as exact real numbers: what every exact structure is
/// compared with.

/// Nearest hit with its exact parameter.
struct ExactHit {
    uint32_t prim;
    mpq_class t;
};

/// Whether the ray's line, at any t, hits the closed triangle; not if its plane holds the line.
bool hits_line(const Ray& ray, const Triangle& triangle);

/// t of the ray's line and the triangle's plane; nothing where they are parallel.
std::optional<mpq_class> plane_parameter(const Ray& ray, const Triangle& triangle);

/// t of the ray and the closed triangle, in the ray's range; nothing for a miss, a triangle without area, or
/// a plane that holds the ray.
std::optional<mpq_class> intersect(const Ray& ray, const Triangle& triangle);

/// Smallest t, of equal ones the lowest primitive.
std::optional<ExactHit> closest_hit(const Mesh& mesh, const Ray& ray);

/// The float nearest to value, ties to even; infinity beyond the largest float's rounding range.
float round_to_float(const mpq_class& value);

/// Whether the ray meets the closed box within its range.
bool meets(const Ray& ray, const Box& box);

}  // namespace boxwood::oracle
