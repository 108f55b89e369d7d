// The SPIR-V that is embedded: exact arithmetic, no names, the right capabilities.
#include "compile.hpp"
#include "emit.hpp"
#include "fix_constants.hpp"
#include "optimise.hpp"
#include "shader_compile/fixture.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace argand::shader_compile {
namespace {

// Numbers of the SPIR-V specification, section 3.
constexpr std::uint32_t op_name = 5, op_ext_inst = 12, op_type_float = 22, op_type_vector = 23,
                        op_type_matrix = 24, op_spec_constant_false = 49, op_function = 54,
                        op_decorate = 71, op_fnegate = 127, op_fadd = 129, op_fsub = 131,
                        op_fmul = 133, op_fdiv = 136, op_frem = 140, op_fmod = 141,
                        op_vector_times_scalar = 142, op_dot = 148, no_contraction = 42;

struct Instruction {
    std::uint32_t op;
    std::vector<std::uint32_t> words; ///< operands
};

std::vector<Instruction> instructions(const Spirv& spirv) {
    std::vector<Instruction> result;
    for (std::size_t i = 5; i < spirv.size(); i += spirv[i] >> 16) {
        result.push_back({spirv[i] & 0xffffu,
                          {spirv.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                           spirv.begin() + static_cast<std::ptrdiff_t>(i + (spirv[i] >> 16))}});
    }
    return result;
}

struct Arithmetic {
    std::map<std::uint32_t, int> count; ///< of each float operation
    int not_decorated = 0;
    int decorated_twice = 0;
};

Arithmetic arithmetic(const Spirv& spirv) {
    const std::set<std::uint32_t> simple{op_fnegate, op_fadd, op_fsub, op_fmul,
                                         op_fdiv,    op_frem, op_fmod};
    Arithmetic result;
    std::set<std::uint32_t> float_types;
    std::map<std::uint32_t, int> decorated;
    for (const auto& [op, words] : instructions(spirv)) {
        if (op == op_type_float ||
            ((op == op_type_vector || op == op_type_matrix) && float_types.contains(words[1]))) {
            float_types.insert(words[0]);
        } else if (op == op_decorate && words[1] == no_contraction) {
            ++decorated[words[0]];
        } else if (simple.contains(op) || (op >= op_vector_times_scalar && op <= op_dot) ||
                   (op == op_ext_inst && float_types.contains(words[0]))) {
            ++result.count[op];
            result.not_decorated += decorated[words[1]] == 0 ? 1 : 0;
            result.decorated_twice += decorated[words[1]] > 1 ? 1 : 0;
        }
    }
    return result;
}

int count_of(const Spirv& spirv, std::uint32_t op) {
    int count = 0;
    for (const Instruction& instruction : instructions(spirv)) {
        count += instruction.op == op ? 1 : 0;
    }
    return count;
}

struct FinalSpirv : ShaderCompile {
    Compiled compiled(const std::string& body) const {
        write("shaders/comp/test.comp", head + body);
        return shader_compile::compile((root / "shaders/comp/test.comp").string(), directories());
    }
    std::vector<std::string> directories() const {
        return {(root / "shaders").string(), (root / "shaders/comp").string()};
    }
};

const std::string arithmetic_body = R"(
layout(set = 0, binding = 0) buffer A { vec4 a[]; };
layout(set = 0, binding = 1) buffer B { mat3 b[]; };
float twice_and_one(float x) { precise float y = x * 2.0; return y + 1.0; }
float early(float x) {
    if (x > 3.0) {
        return -x / 7.0;
    }
    return mod(x, 3.0) - x;
}
void main() {
    vec4 v = a[1];
    float s = twice_and_one(v.x) + early(v.y) * early(v.z);
    for (int i = 0; i < 4; ++i) {
        s += dot(v, a[i]) + length(a[i].xyz);
    }
    vec3 w = b[0] * v.xyz * s + mix(v.xyz, cross(v.xyz, v.yzw), 0.5);
    a[2] = vec4(w * b[1], 0.0 * s);
    b[2] = b[0] * b[1] * s + outerProduct(w, w);
}
)";

TEST_F(FinalSpirv, EveryFloatOperationForbidsContraction) {
    const Compiled source = compiled(arithmetic_body);
    const Spirv spirv = optimise(source.spirv, "test");
    validate(spirv, "test");
    const Arithmetic found = arithmetic(spirv);
    EXPECT_EQ(found.not_decorated, 0);
    EXPECT_EQ(found.decorated_twice, 0);
    // The kinds are really there: one multiplication and one addition of each inlined function at
    // least.
    for (const std::uint32_t op : {op_fnegate, op_fadd, op_fsub, op_fmul, op_fdiv, op_fmod,
                                   op_vector_times_scalar, op_dot, op_ext_inst}) {
        EXPECT_GT(found.count.at(op), 0) << op;
    }
    EXPECT_GT(arithmetic(source.spirv).not_decorated, 10)
        << "glslang itself decorates only what is precise";
}

TEST_F(FinalSpirv, OptimiserDoesNotReassociateFloats) {
    // (x + 1) + 2 is not x + 3, x * 0 is not 0, and x / 3 is not x * (1/3).
    const Compiled source = compiled(R"(
layout(set = 0, binding = 0) buffer A { float a[]; };
void main() { a[1] = (a[0] + 1.0) + 2.0; a[3] = a[2] * 0.0; a[5] = (a[4] / 3.0) / 5.0; }
)");
    const Arithmetic found = arithmetic(optimise(source.spirv, "test"));
    EXPECT_EQ(found.count,
              (std::map<std::uint32_t, int>{{op_fadd, 2}, {op_fmul, 1}, {op_fdiv, 2}}));
}

TEST_F(FinalSpirv, IsOptimisedAndHasNoNames) {
    const Compiled source = compiled(arithmetic_body);
    const Spirv spirv = optimise(source.spirv, "test");
    EXPECT_EQ(count_of(source.spirv, op_function), 3);
    EXPECT_EQ(count_of(spirv, op_function), 1) << "functions are inlined";
    EXPECT_GT(count_of(source.spirv, op_name), 0);
    EXPECT_EQ(count_of(spirv, op_name), 0);
    EXPECT_EQ(spirv[1], 0x00010500u) << "SPIR-V 1.5";
}

TEST_F(FinalSpirv, LongLoopsAreNotUnrolled) {
    const Compiled source = compiled(R"(
layout(set = 0, binding = 0) buffer A { float a[]; };
void main() { for (int i = 0; i < 1000; ++i) { a[i] = a[i + 1] * 2.0; } }
)");
    EXPECT_EQ(arithmetic(optimise(source.spirv, "test")).count.at(op_fmul), 1);
}

TEST_F(FinalSpirv, InvalidModuleIsRefused) {
    Spirv spirv = optimise(compiled("void main() {}\n").spirv, "test");
    EXPECT_NO_THROW(validate(spirv, "shaders/comp/test.comp"));
    spirv.pop_back(); // OpFunctionEnd
    try {
        validate(spirv, "shaders/comp/test.comp");
        FAIL() << "not refused";
    } catch (const std::exception& error) {
        EXPECT_THAT(
            error.what(),
            testing::StartsWith("shaders/comp/test.comp:1: error: spirv-val refuses the module: "));
    }
}

TEST_F(FinalSpirv, SubgroupsBeyondBasicAreSeen) {
    const std::string basic =
        "#extension GL_KHR_shader_subgroup_basic : require\n"
        "layout(set = 0, binding = 0) buffer A { uint a[]; };\n"
        "void main() { if (subgroupElect()) a[gl_SubgroupID] = gl_SubgroupSize; }\n";
    EXPECT_FALSE(reflect(compiled(basic), directories()).uses_subgroups);
    const std::string ballot = "#extension GL_KHR_shader_subgroup_ballot : require\n"
                               "layout(set = 0, binding = 0) buffer A { uvec4 a[]; };\n"
                               "void main() { a[0] = subgroupBallot(true); }\n";
    EXPECT_TRUE(reflect(compiled(ballot), directories()).uses_subgroups);
    const std::string sum = "#extension GL_KHR_shader_subgroup_arithmetic : require\n"
                            "layout(set = 0, binding = 0) buffer A { uint a[]; };\n"
                            "void main() { a[0] = subgroupAdd(1u); }\n";
    EXPECT_TRUE(reflect(compiled(sum), directories()).uses_subgroups);
}

TEST_F(FinalSpirv, IsTheSameEveryTime) {
    const auto once = [&] {
        const Compiled source = compiled(arithmetic_body);
        return emit_source(
            {"test", "test.comp", reflect(source, directories()), optimise(source.spirv, "test")});
    };
    EXPECT_EQ(once(), once());
}

/// A kernel with a specialization constant of this declaration, which chooses between two results.
std::string kernel_of_kinds(const std::string& declaration) {
    return "layout(set = 0, binding = 0) writeonly buffer Out { float result[]; };\n" +
           declaration +
           "\nvoid main() {\n"
           "    uint i = gl_GlobalInvocationID.x;\n"
           "    if ((kinds & 1u) != 0u) { result[i] = 1.0; }\n"
           "#ifndef ARGAND_LEAN\n"
           "    if ((kinds & 2u) != 0u) { result[i] = sin(float(i)); }\n"
           "#endif\n"
           "}\n";
}

/// Words of an array of SPIR-V in a generated source; 0: it has none of this name.
std::ptrdiff_t words_of(const std::string& source, const std::string& name) {
    const std::size_t begin = source.find(name + "[] = {");
    return begin == std::string::npos
               ? 0
               : std::count(source.begin() + std::ptrdiff_t(begin),
                            source.begin() + std::ptrdiff_t(source.find("};", begin)), ',');
}

TEST_F(ShaderCompile, AnotherDefaultUnderTheMacroGivesALeanModule) {
    const Outcome outcome =
        compile_body(kernel_of_kinds("#ifdef ARGAND_LEAN\n"
                                     "layout(constant_id = 3) const uint kinds = 1u;\n"
                                     "#else\n"
                                     "layout(constant_id = 3) const uint kinds = 3u;\n"
                                     "#endif\n"));
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    const std::string source = generated("bad.cpp");
    EXPECT_NE(source.find(".lean = bad_lean,"), std::string::npos);
    EXPECT_NE(source.find("{0, 1u},"), std::string::npos);
    EXPECT_GT(words_of(source, "bad_lean0_spirv"), 0);
    EXPECT_LT(words_of(source, "bad_lean0_spirv"), words_of(source, "bad_spirv"));
    EXPECT_NE(generated("bad.hpp").find("kinds = 3u"), std::string::npos);
}

TEST_F(FinalSpirv, ConstantsAreFixedById) {
    const Compiled source =
        compiled("layout(set = 0, binding = 0) buffer Out { float result[]; };\n"
                 "layout(constant_id = 3) const bool wavy = false;\n"
                 "layout(constant_id = 5) const bool steep = false;\n"
                 "void main() {\n"
                 "    uint i = gl_GlobalInvocationID.x;\n"
                 "    if (wavy || steep) { result[i] = result[i + 1]; }\n"
                 "    if (wavy) { result[i] *= 2.0; }\n"
                 "    if (steep) { result[i] += 2.0; }\n"
                 "}\n");
    const Spirv all = optimise(source.spirv, "test");
    EXPECT_EQ(count_of(all, op_spec_constant_false), 2);
    EXPECT_EQ(count_of(all, op_fmul), 1);
    const Spirv fixed = optimise(fix_constants(source.spirv, {3}), "test");
    validate(fixed, "test");
    EXPECT_EQ(count_of(fixed, op_spec_constant_false), 1);
    EXPECT_EQ(count_of(fixed, op_fmul), 0);
    EXPECT_EQ(count_of(fixed, op_fadd), 1);
    EXPECT_EQ(fix_constants(source.spirv, {}), source.spirv);
}

TEST_F(ShaderCompile, ALeanModuleHasAPartOfTheBits) {
    for (const char* defaults : {"uint kinds = 4u|uint kinds = 3u", "int kinds = 1|int kinds = 3",
                                 "bool kinds = true|bool kinds = false"}) {
        const std::string text = defaults;
        const std::size_t bar = text.find('|');
        const Outcome outcome = compile_body(
            "layout(set = 0, binding = 0) writeonly buffer Out { float result[]; };\n"
            "#ifdef ARGAND_LEAN\n"
            "layout(constant_id = 3) const " +
            text.substr(0, bar) + ";\n#else\nlayout(constant_id = 3) const " +
            text.substr(bar + 1) + ";\n#endif\nvoid main() { result[0] = float(kinds); }\n");
        EXPECT_NE(outcome.status, 0) << text;
        EXPECT_NE(outcome.said.find("neither false nor a part of the bits"), std::string::npos)
            << outcome.said;
    }
}

TEST_F(ShaderCompile, WithoutAnotherDefaultThereIsNoLeanModule) {
    EXPECT_EQ(
        compile_body(kernel_of_kinds("layout(constant_id = 3) const uint kinds = 3u;")).status, 0);
    EXPECT_EQ(generated("bad.cpp").find("lean"), std::string::npos);
}

} // namespace
} // namespace argand::shader_compile
