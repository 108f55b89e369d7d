// The number of elements of a kernel with a CountRecord among its params and a buffer `counts`.
#define ELEMENT_COUNT                                                                              \
    (params.count.on_device != 0u ? min(counts[params.count.index], params.count.number)           \
                                  : params.count.number)
