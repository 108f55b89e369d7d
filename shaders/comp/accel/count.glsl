// The number of elements of a kernel with `params` (AccelParams) and a buffer `counts`.
#define ELEMENT_COUNT (params.count_index == no_count_index ? params.count : counts[params.count_index])
