#include "fix_constants.hpp"

#include <spirv_cross/spirv.hpp>

namespace argand::shader_compile {
namespace {

spv::Op fixed(spv::Op op) {
    switch (op) {
    case spv::OpSpecConstantTrue:
        return spv::OpConstantTrue;
    case spv::OpSpecConstantFalse:
        return spv::OpConstantFalse;
    default:
        return op;
    }
}

} // namespace

Spirv fix_constants(const Spirv& spirv, const std::set<std::uint32_t>& ids) {
    Spirv result(spirv.begin(), spirv.begin() + header_words);
    std::set<std::uint32_t> results; // of the instructions that declare these constants
    for (std::size_t i = header_words; i < spirv.size(); i += spirv[i] >> spv::WordCountShift) {
        const std::uint32_t words = spirv[i] >> spv::WordCountShift;
        const auto op = static_cast<spv::Op>(spirv[i] & spv::OpCodeMask);
        if (op == spv::OpDecorate && spirv[i + 2] == spv::DecorationSpecId &&
            ids.contains(spirv[i + 3])) {
            results.insert(spirv[i + 1]);
            continue;
        }
        const auto begin = spirv.begin() + static_cast<std::ptrdiff_t>(i);
        result.insert(result.end(), begin, begin + words);
        if (words == 3 && results.contains(spirv[i + 2])) { // its type is word 1
            result[result.size() - 3] = (words << spv::WordCountShift) | fixed(op);
        }
    }
    return result;
}

} // namespace argand::shader_compile
