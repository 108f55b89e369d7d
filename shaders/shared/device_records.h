#ifndef ARGAND_SHARED_DEVICE_RECORDS_H
#define ARGAND_SHARED_DEVICE_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Turns a thread count that only the device knows into the group counts of an indirect dispatch.
struct IndirectGroupsParams {
    uint count_index; // of the thread count
    uint group_size;  // threads per group
    uint slot;        // of the result
    uint group_limit; // groups per dimension that the device allows
};

ARGAND_SHARED_END

#endif
