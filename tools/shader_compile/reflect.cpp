#include "reflect.hpp"

#include "annotations.hpp"
#include "base/error.hpp"
#include "names.hpp"

#include <spirv_cross/spirv_cross.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace argand::shader_compile {
namespace {

using spirv_cross::Compiler;
using spirv_cross::Resource;
using spirv_cross::SPIRType;

struct Reader {
    const Compiler& spirv;
    const Sources& sources;
    const std::vector<std::string>& include_directories;
    spirv_cross::ShaderResources resources = spirv.get_shader_resources();

    const SPIRType& without_array(const SPIRType& type) const {
        const SPIRType* inner = &type;
        while (!inner->array.empty()) {
            inner = &spirv.get_type(inner->parent_type);
        }
        return *inner;
    }

    /// The included header under shared/ that declares `struct name`, as C++ includes it.
    std::optional<std::string> shared_header(const std::string& name) const {
        for (const Source& source : sources) {
            const std::string path = shared_path(source, include_directories);
            if (!path.empty() && line_of(without_comments(source.text), {"struct", name, "{"})) {
                return path;
            }
        }
        return std::nullopt;
    }

    /// The group of the file in which these words declare something; empty if it has none.
    std::string group(std::initializer_list<std::string_view> words) const {
        for (const Source& source : sources) {
            const std::string name = group_of(source.path);
            if (!name.empty() && line_of(without_comments(source.text), words)) {
                return name;
            }
        }
        return "";
    }

    Record record(const SPIRType& type, std::string header, std::uint32_t size) const {
        Record result{spirv.get_name(type.self), std::move(header), size, {}};
        for (std::uint32_t i = 0; i < type.member_types.size(); ++i) {
            const bool is_array = !spirv.get_type(type.member_types[i]).array.empty();
            result.members.push_back(
                {spirv.get_member_name(type.self, i), spirv.type_struct_member_offset(type, i),
                 is_array ? spirv.type_struct_member_array_stride(type, i) : 0});
        }
        return result;
    }
};

/// Whether it is a utextureBuffer, through which a kernel reads a buffer with texture units.
bool is_texels(const Reader& reader, const Resource& image) {
    const SPIRType& type = reader.spirv.get_type(image.type_id);
    return type.image.dim == spv::DimBuffer && type.image.sampled == 1 &&
           reader.spirv.get_type(type.image.type).basetype == SPIRType::UInt;
}

void refuse_other_resources(const Reader& reader) {
    const auto refuse = [&](const spirv_cross::SmallVector<Resource>& found,
                            std::string_view what) {
        for (const Resource& resource : found) {
            if (!is_texels(reader, resource)) {
                fail("{}{} '{}': a kernel takes storage buffers, utextureBuffers, push constants "
                     "and "
                     "specialization constants only",
                     error_at(reader.sources, {resource.name}), what, resource.name);
            }
        }
    };
    const spirv_cross::ShaderResources& resources = reader.resources;
    refuse(resources.uniform_buffers, "uniform buffer");
    refuse(resources.sampled_images, "sampled image");
    refuse(resources.separate_images, "sampled image");
    refuse(resources.separate_samplers, "sampler");
    refuse(resources.storage_images, "storage image");
    refuse(resources.atomic_counters, "atomic counter");
    refuse(resources.acceleration_structures, "acceleration structure");
}

Access access_of(const Reader& reader, const Resource& buffer) {
    const spirv_cross::Bitset flags = reader.spirv.get_buffer_block_flags(buffer.id);
    const bool no_write = flags.get(spv::DecorationNonWritable);
    const bool no_read = flags.get(spv::DecorationNonReadable);
    if (no_write && no_read) {
        fail("{}buffer {} is both readonly and writeonly",
             error_at(reader.sources, {"buffer", buffer.name}), buffer.name);
    }
    return no_write ? Access::read : no_read ? Access::write : Access::read_write;
}

/// The C++ type of a storage buffer's elements.
std::string element_type(const Reader& reader, const SPIRType& block) {
    const SPIRType& element =
        reader.without_array(reader.spirv.get_type(block.member_types.back()));
    const std::string vector = element.vecsize > 1 ? fmt::format("vec{}", element.vecsize) : "";
    switch (element.basetype) {
    case SPIRType::Struct: {
        const std::string name = reader.spirv.get_name(element.self);
        return reader.shared_header(name) ? name : "void";
    }
    case SPIRType::UInt:
        return vector.empty() ? "uint" : "u" + vector;
    case SPIRType::Float:
        return vector.empty() ? "float" : vector;
    default:
        return "void";
    }
}

/// Appends a letter for each 32-bit word of a type: 'f' a float, 'u' anything else.
void append_words(const Reader& reader, const SPIRType& type, std::string& words) {
    if (!type.array.empty()) {
        const SPIRType& element = reader.spirv.get_type(type.parent_type);
        for (std::uint32_t i = 0; i < type.array.back(); ++i) {
            append_words(reader, element, words);
        }
    } else if (type.basetype == SPIRType::Struct) {
        for (std::uint32_t i = 0; i < type.member_types.size(); ++i) {
            // std430 may leave gaps between members.
            words.resize(reader.spirv.type_struct_member_offset(type, i) / 4, 'u');
            append_words(reader, reader.spirv.get_type(type.member_types[i]), words);
        }
    } else {
        words.append(std::size_t(type.vecsize) * type.columns,
                     type.basetype == SPIRType::Float ? 'f' : 'u');
    }
}

std::string element_words(const Reader& reader, const SPIRType& block) {
    std::string words;
    append_words(reader, reader.without_array(reader.spirv.get_type(block.member_types.back())),
                 words);
    const auto last = static_cast<std::uint32_t>(block.member_types.size() - 1);
    if (!reader.spirv.get_type(block.member_types.back()).array.empty()) {
        words.resize(reader.spirv.type_struct_member_array_stride(block, last) / 4, 'u');
    }
    return words;
}

/// The included headers that C++ includes as well, without kernels' bodies.
std::vector<std::string> shared_headers(const Reader& reader) {
    std::vector<std::string> headers;
    for (const Source& source : reader.sources) {
        const std::string path = shared_path(source, reader.include_directories);
        if (!path.empty() && !path.starts_with("shared/kernels/")) {
            headers.push_back(path);
        }
    }
    std::sort(headers.begin(), headers.end());
    return headers;
}

void add_record(const Reader& reader, const SPIRType& block, Reflection& result) {
    const auto last = static_cast<std::uint32_t>(block.member_types.size() - 1);
    const SPIRType& member = reader.spirv.get_type(block.member_types[last]);
    const SPIRType& element = reader.without_array(member);
    if (element.basetype != SPIRType::Struct || member.array.empty()) {
        return;
    }
    const std::string name = reader.spirv.get_name(element.self);
    const bool known = std::any_of(result.records.begin(), result.records.end(),
                                   [&](const Record& r) { return r.name == name; });
    const std::optional<std::string> header = reader.shared_header(name);
    if (header && !known) {
        result.records.push_back(reader.record(
            element, *header, reader.spirv.type_struct_member_array_stride(block, last)));
    }
}

void read_buffers(const Reader& reader, bool is_group, Reflection& result) {
    std::map<std::uint32_t, const Resource*> by_binding;
    std::vector<const Resource*> buffers;
    for (const auto* found :
         {&reader.resources.storage_buffers, &reader.resources.separate_images}) {
        for (const Resource& buffer : *found) {
            buffers.push_back(&buffer);
        }
    }
    for (const Resource* found : buffers) {
        const Resource& buffer = *found;
        const bool image = reader.spirv.get_type(buffer.type_id).basetype == SPIRType::Image;
        const std::string at =
            error_at(reader.sources, {image ? "utextureBuffer" : "buffer", buffer.name});
        const std::uint32_t set =
            reader.spirv.get_decoration(buffer.id, spv::DecorationDescriptorSet);
        const std::uint32_t binding =
            reader.spirv.get_decoration(buffer.id, spv::DecorationBinding);
        if (set != 0) {
            fail("{}buffer {} is in set {}; every buffer of a kernel is in set 0", at, buffer.name,
                 set);
        }
        if (!reader.spirv.get_type(buffer.type_id).array.empty()) {
            fail("{}buffer {} is an array of buffers; declare each with a binding of its own", at,
                 buffer.name);
        }
        const auto [other, is_new] = by_binding.emplace(binding, &buffer);
        if (!is_new) {
            fail("{}buffers {} and {} both have binding {}", at, other->second->name, buffer.name,
                 binding);
        }
    }
    const std::uint32_t before = is_group && !by_binding.empty() ? by_binding.begin()->first : 0;
    for (const auto& [binding, buffer] : by_binding) {
        const std::string at = error_at(reader.sources, {"buffer", buffer->name});
        if (binding != before + result.bindings.size()) {
            fail("{}buffer {} has binding {} but none has binding {}; bindings are 0, 1, 2, ... "
                 "without a gap",
                 at, buffer->name, binding, result.bindings.size());
        }
        if (result.bindings.size() == max_bindings) {
            fail("{}buffer {} is one too many: a kernel has at most {}", at, buffer->name,
                 max_bindings);
        }
        const SPIRType& block = reader.spirv.get_type(buffer->base_type_id);
        if (block.basetype == SPIRType::Image) {
            result.bindings.push_back({.name = buffer->name,
                                       .group = reader.group({"utextureBuffer", buffer->name}),
                                       .access = Access::read,
                                       .texels = true,
                                       .type = "uvec4",
                                       .words = "uuuu"});
            continue;
        }
        const auto last = static_cast<std::uint32_t>(block.member_types.size() - 1);
        result.bindings.push_back({.name = reader.spirv.get_member_name(block.self, last),
                                   .group = reader.group({"buffer", buffer->name, "{"}),
                                   .access = access_of(reader, *buffer),
                                   .type = element_type(reader, block),
                                   .words = element_words(reader, block)});
        add_record(reader, block, result);
    }
}

void read_push(const Reader& reader, Reflection& result) {
    if (reader.resources.push_constant_buffers.empty()) {
        return;
    }
    const Resource& push = reader.resources.push_constant_buffers.front();
    const std::string at =
        error_at(reader.sources, {"uniform", reader.spirv.get_name(push.base_type_id)});
    const SPIRType& block = reader.spirv.get_type(push.base_type_id);
    const SPIRType& type = reader.spirv.get_type(block.member_types.front());
    if (block.member_types.size() != 1 || type.basetype != SPIRType::Struct ||
        !type.array.empty() || reader.spirv.type_struct_member_offset(block, 0) != 0) {
        fail("{}the push constant block has exactly one member, of a struct type declared under "
             "shaders/shared/, at "
             "offset 0",
             at);
    }
    const std::string name = reader.spirv.get_name(type.self);
    const std::size_t size = reader.spirv.get_declared_struct_size(type);
    if (size > max_push_bytes) {
        fail("{}push constants {} take {} bytes; every device has room for {}: move some to a "
             "buffer",
             at, name, size, max_push_bytes);
    }
    const std::optional<std::string> header = reader.shared_header(name);
    if (!header) {
        fail(
            "{}no included header under shaders/shared/ declares struct {}, which C++ needs to see",
            at, name);
    }
    result.push = reader.record(type, *header, static_cast<std::uint32_t>(size));
    result.push_name = reader.spirv.get_member_name(block.self, 0);
}

std::string float_literal(float value) {
    if (!std::isfinite(value)) {
        return std::isnan(value)
                   ? "std::numeric_limits<float>::quiet_NaN()"
                   : fmt::format("{}std::numeric_limits<float>::infinity()", value < 0 ? "-" : "");
    }
    std::string text = fmt::format("{}", value);
    return text + (text.find_first_of(".e") == std::string::npos ? ".0f" : "f");
}

void read_constants(const Reader& reader, Reflection& result) {
    for (const spirv_cross::SpecializationConstant& found :
         reader.spirv.get_specialization_constants()) {
        const std::string name = reader.spirv.get_name(found.id);
        const spirv_cross::SPIRConstant& constant = reader.spirv.get_constant(found.id);
        const SPIRType& type = reader.spirv.get_type(constant.constant_type);
        Constant entry{name, reader.group({name, "="}), found.constant_id, "", ""};
        switch (type.basetype) {
        case SPIRType::Boolean:
            entry.type = "bool";
            entry.value = constant.scalar() != 0 ? "true" : "false";
            break;
        case SPIRType::Int:
            entry.type = "std::int32_t";
            entry.value = fmt::format("{}", constant.scalar_i32());
            break;
        case SPIRType::UInt:
            entry.type = "std::uint32_t";
            entry.value = fmt::format("{}u", constant.scalar());
            break;
        case SPIRType::Float:
            entry.type = "float";
            entry.value = float_literal(constant.scalar_f32());
            break;
        default:
            fail("{}specialization constant {} is neither bool, int, uint nor float",
                 error_at(reader.sources, {name}), name);
        }
        result.constants.push_back(std::move(entry));
    }
    std::sort(result.constants.begin(), result.constants.end(),
              [](const Constant& a, const Constant& b) { return a.id < b.id; });
    if (result.constants.size() > max_constants) {
        const std::string& name = result.constants[max_constants].name;
        fail("{}specialization constant {} is one too many: a kernel has at most {}",
             error_at(reader.sources, {name}), name, max_constants);
    }
}

void read_local_size(const Reader& reader, Reflection& result) {
    std::array<spirv_cross::SpecializationConstant, 3> specialized;
    reader.spirv.get_work_group_size_specialization_constants(specialized[0], specialized[1],
                                                              specialized[2]);
    for (std::uint32_t i = 0; i < 3; ++i) {
        if (static_cast<std::uint32_t>(specialized[i].id) != 0) {
            const std::string name = fmt::format("local_size_{}_id", "xyz"[i]);
            fail("{}{}: the local size cannot be specialized; write it as a number",
                 error_at(reader.sources, {name}), name);
        }
        result.local_size[i] =
            reader.spirv.get_execution_mode_argument(spv::ExecutionModeLocalSize, i);
    }
}

/// The shaders of raster programs read buffers, and the fragment shader writes unsigned words.
void read_raster_stage(const Reader& reader, Reflection& result) {
    for (const Binding& binding : result.bindings) {
        if (binding.access != Access::read) {
            fail("{}buffer {} is not readonly; a raster program writes its result only",
                 error_at(reader.sources, {binding.name}), binding.name);
        }
    }
    const auto& results = reader.resources.stage_outputs;
    if (reader.spirv.get_execution_model() == spv::ExecutionModelVertex) {
        for (const Resource& input : reader.resources.stage_inputs) {
            fail("{}input {}: a vertex shader reads its vertices from buffers",
                 error_at(reader.sources, {input.name}), input.name);
        }
        return;
    }
    const SPIRType* type =
        results.size() == 1 ? &reader.spirv.get_type(results[0].type_id) : nullptr;
    if (!type || type->basetype != SPIRType::UInt || type->vecsize == 3 || !type->array.empty()) {
        fail("{}a fragment shader has one output, of type uint, uvec2 or uvec4",
             error_at(reader.sources, {results.empty() ? "no output" : results[0].name}));
    }
    result.result_words = type->vecsize;
}

bool uses_subgroups(const Compiler& spirv) {
    const auto& capabilities = spirv.get_declared_capabilities();
    return std::any_of(capabilities.begin(), capabilities.end(), [](spv::Capability capability) {
        return capability >= spv::CapabilityGroupNonUniformVote &&
               capability <= spv::CapabilityGroupNonUniformQuad;
    });
}

/// Names become members of C++ structs: the kernel's, its constants', and those of its groups,
/// which are members themselves.
void check_names(const Reader& reader, const Reflection& result) {
    std::map<std::string, std::set<std::string>> taken; // by struct
    taken["bindings "] = {"info", "arguments", "constants", "Constants",
                          std::filesystem::path(reader.sources.front().path).stem().string()};
    const auto take = [&](const std::string& structure, const std::string& name) {
        if (!is_cpp_name(name) || !taken[structure].insert(name).second) {
            fail("{}the name '{}' cannot be a member of the kernel's C++ struct: it is a keyword "
                 "or taken; choose another",
                 error_at(reader.sources, {name}), name);
        }
    };
    std::set<std::string> groups;
    for (const Binding& binding : result.bindings) {
        groups.insert(binding.group);
        take("bindings " + binding.group, binding.name);
    }
    for (const Constant& constant : result.constants) {
        groups.insert(constant.group);
        take("constants " + constant.group, constant.name);
    }
    groups.erase("");
    for (const std::string& group : groups) {
        take("bindings ", group);
        take("constants ", group);
    }
    if (result.push) {
        take("bindings ", result.push_name);
    }
}

} // namespace

std::string group_of(const std::string& path) {
    constexpr std::string_view ending = "_bindings.glsl";
    const std::string file = std::filesystem::path(path).filename().string();
    return file.ends_with(ending) ? file.substr(0, file.size() - ending.size()) : "";
}

Reflection reflect(const Compiled& compiled, const std::vector<std::string>& include_directories,
                   bool is_group) {
    try {
        const Compiler spirv(compiled.spirv);
        const Reader reader{spirv, compiled.sources, include_directories};
        Reflection result{};
        refuse_other_resources(reader);
        read_buffers(reader, is_group, result);
        read_push(reader, result);
        if (spirv.get_execution_model() == spv::ExecutionModelGLCompute) {
            read_local_size(reader, result);
        } else {
            read_raster_stage(reader, result);
        }
        read_constants(reader, result);
        check_names(reader, result);
        result.uses_subgroups = uses_subgroups(spirv);
        result.headers = shared_headers(reader);
        annotate(compiled.sources, include_directories, result);
        return result;
    } catch (const spirv_cross::CompilerError& error) {
        fail("{}:1: error: cannot reflect the SPIR-V: {}", compiled.sources.front().path,
             error.what());
    }
}

} // namespace argand::shader_compile
