#include "optimise.hpp"

#include "base/error.hpp"
#include "contraction.hpp"

#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

namespace argand::shader_compile {
namespace {

spvtools::MessageConsumer append_to(std::string& text) {
    return [&text](spv_message_level_t level, const char*, const spv_position_t&,
                   const char* message) {
        if (level <= SPV_MSG_ERROR) {
            text += text.empty() ? message : fmt::format("; {}", message);
        }
    };
}

} // namespace

Spirv optimise(const Spirv& spirv, const std::string& kernel) {
    std::string said;
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.SetMessageConsumer(append_to(said));
    optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    optimizer.RegisterPerformancePasses();
    optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
    optimizer.RegisterPass(spvtools::CreateCompactIdsPass());

    const Spirv exact = forbid_contraction(spirv);
    Spirv result;
    spvtools::OptimizerOptions options;
    options.set_run_validator(false); // validate() does, with a better message
    if (!optimizer.Run(exact.data(), exact.size(), &result, options)) {
        fail("{}:1: error: spirv-opt fails: {}", kernel, said);
    }
    return forbid_contraction(result);
}

void validate(const Spirv& spirv, const std::string& kernel) {
    std::string said;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    tools.SetMessageConsumer(append_to(said));
    if (!tools.Validate(spirv)) {
        fail("{}:1: error: spirv-val refuses the module: {}", kernel, said);
    }
}

} // namespace argand::shader_compile
