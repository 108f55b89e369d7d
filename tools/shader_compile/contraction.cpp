#include "contraction.hpp"

#include <spirv_cross/spirv.hpp>

#include <set>

namespace argand::shader_compile {
namespace {

bool is_float_arithmetic(spv::Op op) {
    switch (op) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpOuterProduct:
    case spv::OpDot:
        return true;
    default:
        return false;
    }
}

/// Whether the instruction precedes annotations in a module (SPIR-V specification, 2.4).
/// Decorations may be inserted before the first one that does not.
bool is_before_annotations(spv::Op op) {
    switch (op) {
    case spv::OpCapability:
    case spv::OpExtension:
    case spv::OpExtInstImport:
    case spv::OpMemoryModel:
    case spv::OpEntryPoint:
    case spv::OpExecutionMode:
    case spv::OpExecutionModeId:
    case spv::OpString:
    case spv::OpSource:
    case spv::OpSourceContinued:
    case spv::OpSourceExtension:
    case spv::OpName:
    case spv::OpMemberName:
    case spv::OpModuleProcessed:
        return true;
    default:
        return false;
    }
}

} // namespace

Spirv forbid_contraction(const Spirv& spirv) {
    std::set<std::uint32_t> float_types;
    std::set<std::uint32_t> decorated;
    std::vector<std::uint32_t> results;
    std::size_t insert_at = 0;
    for (std::size_t i = header_words; i < spirv.size(); i += spirv[i] >> spv::WordCountShift) {
        const auto op = static_cast<spv::Op>(spirv[i] & spv::OpCodeMask);
        if (insert_at == 0 && !is_before_annotations(op)) {
            insert_at = i;
        }
        const bool is_compound = op == spv::OpTypeVector || op == spv::OpTypeMatrix;
        if (op == spv::OpTypeFloat || (is_compound && float_types.count(spirv[i + 2]) != 0)) {
            float_types.insert(spirv[i + 1]);
        } else if (op == spv::OpDecorate && spirv[i + 2] == spv::DecorationNoContraction) {
            decorated.insert(spirv[i + 1]);
        } else if (is_float_arithmetic(op) ||
                   (op == spv::OpExtInst && float_types.count(spirv[i + 1]) != 0)) {
            // Extended instructions too: mix, length, cross and others expand to products and sums.
            results.push_back(spirv[i + 2]);
        }
    }
    Spirv decorations;
    for (const std::uint32_t id : results) {
        if (decorated.count(id) == 0) {
            decorations.insert(decorations.end(),
                               {(3u << spv::WordCountShift) | spv::OpDecorate, id,
                                static_cast<std::uint32_t>(spv::DecorationNoContraction)});
        }
    }
    Spirv result = spirv;
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(insert_at), decorations.begin(),
                  decorations.end());
    return result;
}

} // namespace argand::shader_compile
