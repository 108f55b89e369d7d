// As query.glsl, for estimators that walk the map once per query.
#include "photon/query.glsl"

layout(set = 0, binding = 9) buffer Gathers { GatherRecord gathers[]; };
