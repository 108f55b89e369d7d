#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/camera.h"
#include "shared/geometry_records.h"
#include "shared/path_records.h"

layout(set = 0, binding = 0) readonly buffer Cameras { CameraRecord camera[]; };
layout(set = 0, binding = 1) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 2) writeonly buffer Active { uint active_slots[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

// Whether the film is a part of the image.
layout(constant_id = 0) const bool cropped = true;

#include "shared/kernels/methods/center_rays.h"
