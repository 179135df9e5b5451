#pragma once

#include "core/scene/scene.h"

namespace boxwood {

// The generators of the built-in scenes: `make` of BuiltInScene. Each fills mesh and camera, and gives the
// same bits on every compiler: random numbers are of rng.h; sines are taken in double and rounded to float,
// which hides the last bit in which libraries differ. After a stop the mesh is unfinished.

/// A court of two storeys with columns, arches, vaults, stairs and an open roof; units are metres.
void make_atrium(const SceneOptions& options, Scene& scene, Task& task);
/// A ship of long thin hull plates with small detail, turned by 45 degrees about (1, 1, 1).
void make_spaceship(const SceneOptions& options, Scene& scene, Task& task);
/// A room of a few huge triangles, finely cut furniture, and parts that move: doors, drawers, a chair, a fan,
/// a mixer, a ball, a thrown spoon, a lamp, a pendulum. Option frame: 0 to kKitchenFrames - 1, 24 a second;
/// the motion is a loop. Objects that move have names that begin with "moving"; each of their parts is rigid.
inline constexpr int kKitchenFrames = 120;
void make_kitchen(const SceneOptions& options, Scene& scene, Task& task);
/// The Cornell box: room, light and two blocks.
void make_cornell(const SceneOptions& options, Scene& scene, Task& task);
/// Two long slanting triangles whose boxes overlap.
void make_two_triangles(const SceneOptions& options, Scene& scene, Task& task);
/// One CAD surface, the outside mirror of a car, at two tessellations: about 85,651 and 334,080 triangles.
/// Ernst and Greiner 2007, figure 3.
void make_mirror_low(const SceneOptions& options, Scene& scene, Task& task);
void make_mirror_high(const SceneOptions& options, Scene& scene, Task& task);
/// A hall full of pipes with flanges, bends and valves, on girders and gratings; about 1,667,578 triangles.
/// Ernst and Greiner 2007, figure 3.
void make_power_plant(const SceneOptions& options, Scene& scene, Task& task);
/// Smooth, dense height field. Option tris: about how many triangles, "k" and "M" for thousands and millions.
void make_terrain(const SceneOptions& options, Scene& scene, Task& task);

}  // namespace boxwood
