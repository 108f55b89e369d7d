#pragma once

#include "device/kernel.hpp"

#include <bit>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <spirv-tools/optimizer.hpp>
#include <spirv/unified1/spirv.hpp11>
#include <string>
#include <unordered_map>
#include <vector>

namespace argand::testing {

/// The code that remains of a kernel after its constants are specialised and dead code is
/// eliminated.
struct SpecialisedCode {
    std::size_t instructions = 0;  ///< in functions
    std::set<std::string> buffers; ///< names of the bindings that it reads or writes
    std::set<float> numbers;       ///< literals
};

/// Removes unreachable and unused code like a driver, without other optimisations.
inline SpecialisedCode specialised(const KernelInfo& kernel,
                                   const std::vector<std::uint32_t>& constants) {
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
    for (std::size_t i = 0; i < constants.size(); ++i) {
        values[kernel.constants[i].id] = {constants[i]};
    }
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    // The build inlines kernels and converts them to SSA form.
    for (int round = 0; round < 2; ++round) {
        optimizer.RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    }
    std::vector<std::uint32_t> code;
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    const std::span<const std::uint32_t> spirv = module_for(kernel, constants);
    EXPECT_TRUE(optimizer.Run(spirv.data(), spirv.size(), &code, options)) << kernel.name;

    SpecialisedCode found;
    std::map<std::uint32_t, std::uint32_t> binding_of;
    std::set<std::uint32_t> float_types;
    bool in_function = false;
    constexpr std::size_t header_words = 5;
    for (std::size_t at = header_words; at < code.size();) {
        const std::uint32_t words = code[at] >> 16;
        const auto op = static_cast<spv::Op>(code[at] & 0xffff);
        const std::uint32_t* operands = code.data() + at + 1;
        if (op == spv::Op::OpDecorate &&
            operands[1] == static_cast<std::uint32_t>(spv::Decoration::Binding)) {
            binding_of[operands[0]] = operands[2];
        } else if (op == spv::Op::OpTypeFloat && operands[1] == 32) {
            float_types.insert(operands[0]);
        } else if (op == spv::Op::OpConstant && float_types.contains(operands[0])) {
            found.numbers.insert(std::bit_cast<float>(operands[2]));
        }
        in_function = in_function || op == spv::Op::OpFunction;
        found.instructions += in_function ? 1 : 0;
        if (op == spv::Op::OpAccessChain || op == spv::Op::OpLoad) {
            if (const auto variable = binding_of.find(operands[2]); variable != binding_of.end()) {
                for (const KernelBinding& binding : kernel.bindings) {
                    if (binding.binding == variable->second) {
                        found.buffers.insert(binding.name);
                    }
                }
            }
        }
        at += words;
    }
    return found;
}

} // namespace argand::testing
