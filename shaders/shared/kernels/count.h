// Number of elements, for kernels that have a CountRecord in their params and a buffer `counts`.
#define ELEMENT_COUNT                                                                              \
    (params.count.on_device != 0u ? min(counts[params.count.index], params.count.number)           \
                                  : params.count.number)
