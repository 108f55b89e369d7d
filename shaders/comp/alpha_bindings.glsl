// What the kernels that trace rays past surfaces with alpha read of the scene; behind their other
// buffers, of which there are ALPHA_BINDING.
#include "shared/alpha.h"
#include "shared/material_record.h"
#include "shared/scene_records.h"
#include "shared/texture.h"

#ifndef ALPHA_BINDING
#define ALPHA_BINDING 0
#endif
layout(set = 0, binding = ALPHA_BINDING) readonly buffer SceneBlock { SceneRecord scene[]; };
layout(set = 0, binding = ALPHA_BINDING + 1) readonly buffer Corners { uvec4 corners[]; };
layout(set = 0, binding = ALPHA_BINDING + 2) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = ALPHA_BINDING + 3) readonly buffer Attributes { uvec2 attributes[]; };
layout(set = 0, binding = ALPHA_BINDING + 4) readonly buffer Textures { TextureRecord textures[]; };
layout(set = 0, binding = ALPHA_BINDING + 5) readonly buffer Texels { uint texels[]; };

// Features of the scene, as in texture_bindings.glsl.
layout(constant_id = 20) const bool textured = true;
layout(constant_id = 21) const bool vertex_colors = true;
