#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/scene/generate/mesh_builder.h"

namespace boxwood::kitchen {

// Parts that the pieces of the kitchen are made of, in the placement and object that the builder has.
// Lengths in metres, angles in radians.

/// `placement` turned about its own origin; `axis` is a local unit vector.
Placement turned(const Placement& placement, const DVec3& axis, double angle);

/// A box whose edges and corners are rounded: 12 (2 steps + 1)^2 triangles. `radius` is at most half of each
/// side.
void add_rounded_box(MeshBuilder& b, const DVec3& lower, const DVec3& upper, double radius, int steps);

/// A pipe about the plane curve path(u), u in [0, 1]; `normal` is the unit normal of its plane.
void add_pipe(MeshBuilder& b, const std::function<DVec3(double u)>& path, const DVec3& normal, double radius,
              int along, int around);

/// Points on a smooth curve through the given ones (Catmull and Rom 1974), `steps` for each piece.
std::vector<ProfilePoint> smooth(std::span<const ProfilePoint> points, int steps);

/// The front of a cupboard with a raised panel: x in [0, width], y in [0, height], its back at z = 0.
void add_front(MeshBuilder& b, double width, double height);
/// A turned knob that sticks out along z.
void add_knob(MeshBuilder& b, const DVec3& at);

// Dishes and food: they stand on local y = 0 at `at`.
void add_plate(MeshBuilder& b, const DVec3& at, const DVec3& axis, double radius);
void add_cup(MeshBuilder& b, const DVec3& at, double handle_angle);
void add_bowl(MeshBuilder& b, const DVec3& at, double radius);
void add_bottle(MeshBuilder& b, const DVec3& at);
void add_jar(MeshBuilder& b, const DVec3& at, double height);
void add_pot(MeshBuilder& b, const DVec3& at, double radius, double height);
void add_kettle(MeshBuilder& b, const DVec3& at);
void add_apple(MeshBuilder& b, const DVec3& at, double radius);

// Colours that several pieces share.
void use_enamel(MeshBuilder& b);  ///< of what stands still; parts that move have objects of their own
void use_steel(MeshBuilder& b);
void use_oak(MeshBuilder& b);
void use_china(MeshBuilder& b);

}  // namespace boxwood::kitchen
