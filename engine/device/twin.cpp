#include "device/twin.hpp"

#include "base/error.hpp"

namespace argand {

void check_threads(const KernelInfo& kernel, std::uint64_t threads) {
    if (threads > UINT32_MAX) {
        fail(
            "running kernel {}: {} invocations are more than can be numbered; ask for less at once",
            kernel.name, threads);
    }
}

} // namespace argand
