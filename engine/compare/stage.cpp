#include "compare/stage.hpp"

#include <algorithm>

namespace argand {

namespace {

/// What a kernel's source declares as words although there are floats among them.
std::string layout_of(const std::string& stage, const KernelBinding& binding) {
    const std::string_view name = binding.name;
    if (stage == "trace_closest" && name == "hits") {
        return "ufff";
    }
    if (stage == "lbvh_fit" && (name == "nodes" || name == "costs")) {
        return "fffu";
    }
    return binding.words;
}

} // namespace

std::string stage_name(const KernelInfo& kernel) {
    std::string name = kernel.name;
    constexpr std::string_view texels = "_texels";
    if (name.ends_with(texels)) {
        name.resize(name.size() - texels.size());
    }
    return name;
}

std::vector<WrittenBinding> written_bindings(const KernelInfo& kernel,
                                             const KernelArguments& arguments) {
    const std::string stage = stage_name(kernel);
    std::vector<WrittenBinding> written;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        const auto earlier = arguments.buffers.begin() + i;
        const bool again =
            std::find(arguments.buffers.begin(), earlier, arguments.buffers[i]) != earlier;
        if (kernel.bindings[i].access != Access::read && !again) {
            written.push_back(
                {BufferView(*arguments.buffers[i], arguments.offsets[i], arguments.sizes[i]),
                 kernel.bindings[i].name, layout_of(stage, kernel.bindings[i])});
        }
    }
    return written;
}

} // namespace argand
