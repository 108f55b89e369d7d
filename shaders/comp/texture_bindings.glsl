// The textures of the scene and what vertices have for them, for kernels that evaluate materials.
// They follow the scene's buffers and the features of materials; such a kernel's own buffers begin
// at binding 10.
#include "shared/ray_cone.h"
#include "shared/tangent.h"
#include "shared/texel_tree.h"
#include "shared/texture.h"

layout(set = 0, binding = 7) readonly buffer Attributes { uvec2 attributes[]; };
layout(set = 0, binding = 8) readonly buffer Textures { TextureRecord textures[]; };
layout(set = 0, binding = 9) readonly buffer Texels { uint texels[]; };

// Features of the scene (engine/plan/plan.hpp). Buffers that are not read may be empty.
#ifndef ARGAND_PLAIN
const bool by_default = true;
#else // for scenes that have none of them
const bool by_default = false;
#endif
layout(constant_id = 20) const bool textured = by_default;      // false: textures and texels are not read
layout(constant_id = 21) const bool vertex_colors = by_default; // of the attributes
layout(constant_id = 23) const bool normal_maps = by_default;     // some surfaces have normal textures
layout(constant_id = 24) const bool other_textures = by_default;  // of material_other_textures
layout(constant_id = 25) const bool mip_maps = by_default; // some textures have them, and paths have cones
layout(constant_id = 22) const bool emissive_texels = by_default; // some triangles shine by texels
