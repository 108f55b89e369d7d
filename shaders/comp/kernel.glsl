// Every kernel includes this first: extensions, the shared prelude, and the index of an invocation.
#extension GL_GOOGLE_include_directive : require
#include "shared/prelude.h"

// A dispatch of more than 65,535 groups spills into y and z. These are the linear indices.
// Groups are one-dimensional.
#define GROUP_INDEX \
    (gl_WorkGroupID.x + \
     gl_NumWorkGroups.x * (gl_WorkGroupID.y + gl_NumWorkGroups.y * gl_WorkGroupID.z))
#define THREAD_INDEX (GROUP_INDEX * gl_WorkGroupSize.x + gl_LocalInvocationID.x)
