// redmap: mip-maps for procedural shaders (Van Horn and Turk 2008). This is the contents page of the library:
//
//   surface + shader -> bake -> reduction map -> lookup and shade -> pictures -> compare
#pragma once

// What everything is made of: vectors, linear RGB, pictures and their files, the one exception, threads.
#include "base/error.h"
#include "base/image.h"
#include "base/parallel.h"
#include "base/vec.h"

// Devices: Vulkan for compute.
#include "device/device.h"

// Surfaces: spheres, cylinders and triangle meshes with an atlas. Meshes are read, oriented, repaired and simplified,
// their uv judged, and made where they are not fit.
#include "surface/atlas.h"
#include "surface/atlas_picture.h"
#include "surface/map_size.h"
#include "surface/mesh.h"
#include "surface/mesh_units.h"
#include "surface/prepare.h"
#include "surface/repair.h"
#include "surface/surface.h"
#include "surface/uv_quality.h"

// Shaders: the library's, by name, and what can be set on them.
#include "shader/parameters.h"
#include "shader/shader.h"

// Shaders of your own, from GLSL files.
#include "user_shader/user_shader.h"

// Reduction maps: what they hold, their files, and filtered lookups.
#include "map/footprint.h"
#include "map/map_file.h"
#include "map/pyramid.h"
#include "map/reduction_map.h"

// From surface and shader to a map.
#include "bake/bake.h"

// From a scene and its maps to pictures, on the CPU or on a device.
#include "gpu/device_renderer.h"
#include "render/closest_view.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "scene/scene_file.h"

// How far pictures are from a reference.
#include "metrics/compare.h"
#include "metrics/flip.h"

// Maps that know their own error.
#include "verify/error_picture.h"
#include "verify/verify.h"
