#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene_bindings.glsl"
#include "material_features.glsl"
#include "texture_bindings.glsl"
#include "shared/feature_record.h"
#include "shared/lights.h"
#include "shared/path_records.h"

layout(set = 0, binding = 10) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 11) readonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 12) readonly buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 13) buffer Features { FeatureRecord features[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

#include "shared/kernels/methods/feature_add.h"
