#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier_records.h"
#include "shared/photon.h"
#include "shared/photon_records.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Slots { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 2) readonly buffer Gathers { GatherRecord gathers[]; };
layout(set = 0, binding = 3) writeonly buffer Estimates { EstimateRecord estimates[]; };
layout(push_constant) uniform Push { FrontierAnswerParams params; };

#include "shared/kernels/photon/frontier_answer.h"
