#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/camera.h"
#include "shared/geometry_records.h"
#include "shared/light_path.h"
#include "shared/light_path_records.h"
#include "shared/path_records.h"
#include "shared/pixel_filter.h"
#include "shared/ray_cone.h"
#include "shared/sampling.h"

layout(set = 0, binding = 0) readonly buffer Cameras { CameraRecord camera[]; };
layout(set = 0, binding = 1) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 2) writeonly buffer Paths { PathRecord paths[]; };
layout(set = 0, binding = 3) writeonly buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 4) writeonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 5) writeonly buffer EyeWeights { EyeWeightRecord eye_weights[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

// Whether numbers are points of a lattice.
layout(constant_id = 0) const bool lattice = false;
// Whether rays have cones; else theirs are 0.
layout(constant_id = 1) const bool cones = false;
// Whether the film is a part of the image.
layout(constant_id = 2) const bool cropped = true;
// Whether samples are placed by a filter, instead of evenly in their pixel.
layout(constant_id = 3) const bool filtered = true;
// Whether light paths find the same light.
layout(constant_id = 4) const bool weighed = false;

#include "shared/kernels/methods/camera_rays.h"
