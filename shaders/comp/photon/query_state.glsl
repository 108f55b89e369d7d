// What estimators read and write whose queries take one walk through the map.
#include "photon/query.glsl"

layout(set = 0, binding = 9) buffer Gathers { GatherRecord gathers[]; };
