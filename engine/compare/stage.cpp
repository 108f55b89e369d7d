#include "compare/stage.hpp"

#include <algorithm>

namespace argand {

std::vector<WrittenBinding> written_bindings(const KernelInfo& kernel,
                                             const KernelArguments& arguments) {
    std::vector<WrittenBinding> written;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        const auto earlier = arguments.buffers.begin() + i;
        const bool again =
            std::find(arguments.buffers.begin(), earlier, arguments.buffers[i]) != earlier;
        if (kernel.bindings[i].access != Access::read && !again) {
            written.push_back(
                {BufferView(*arguments.buffers[i], arguments.offsets[i], arguments.sizes[i]),
                 kernel.bindings[i]});
        }
    }
    return written;
}

} // namespace argand
