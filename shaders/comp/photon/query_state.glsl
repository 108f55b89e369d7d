// What estimators read and write whose queries take one walk through the map.
#include "photon/query.glsl"

layout(set = 0, binding = 7) buffer Gathers { GatherRecord gathers[]; };
