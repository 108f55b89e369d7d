// What kernels bind: the scene as one group, and few enough buffers.
#include "device/info.hpp"
#include "support/scratch_directory.hpp"

#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <vector>

namespace argand {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
namespace fs = std::filesystem;

/// Sources with one of these extensions below a folder, by path.
std::map<std::string, std::string> texts(const fs::path& folder,
                                         const std::vector<std::string>& extensions) {
    std::map<std::string, std::string> result;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension();
        if (std::count(extensions.begin(), extensions.end(), extension) > 0) {
            result[fs::relative(entry.path(), folder)] = read_text(entry.path());
        }
    }
    return result;
}

/// The binding that shader_compile wrote for a kernel.
std::string binding_of(const std::string& kernel) {
    const std::string name = fs::path(kernel).stem();
    return read_text(fs::path(ARGAND_BINARY_DIR) / "generated/kernels" / (name + ".hpp"));
}

/// How many buffers a kernel binds.
std::uint32_t buffers_of(const std::string& binding) {
    const std::regex number(R"(///< bindings? (?:\d+ to )?(\d+)\n)");
    std::uint32_t count = 0;
    for (std::sregex_iterator found(binding.begin(), binding.end(), number), end; found != end;
         ++found) {
        count = std::max(count, static_cast<std::uint32_t>(std::stoul((*found)[1])) + 1);
    }
    return count;
}

const fs::path source = ARGAND_SOURCE_DIR;

TEST(Kernels, BindNoMoreThanDevicesHave) {
    std::uint32_t most = 0;
    for (const auto& [kernel, text] : texts(source / "shaders/comp", {".comp"})) {
        const std::uint32_t count = buffers_of(binding_of(kernel));
        EXPECT_GT(count, 0u) << kernel;
        EXPECT_LE(count, Requirements::storage_buffers) << kernel;
        most = std::max(most, count);
    }
    EXPECT_GE(most, 23u); // that of vertices of eye paths: the pattern finds groups too
}

TEST(Kernels, BindTheSceneAsOneGroup) {
    std::size_t count = 0;
    for (const auto& [kernel, text] : texts(source / "shaders/comp", {".comp", ".glsl"})) {
        // Kernels that trace rays past alpha read a few of the scene's buffers behind their own.
        if (kernel == "scene_bindings.glsl" || kernel == "alpha_bindings.glsl") {
            continue;
        }
        EXPECT_THAT(text, Not(HasSubstr("SceneRecord"))) << kernel;
        if (text.find("#include \"scene_bindings.glsl\"") != std::string::npos) {
            EXPECT_THAT(binding_of(kernel), ContainsRegex("SceneBindings +scene;")) << kernel;
            ++count;
        }
    }
    EXPECT_GE(count, 4u);
    std::vector<std::string> fill; // the sources that list the buffers of the scene
    for (const auto& [file, text] : texts(source / "engine", {".cpp", ".hpp"})) {
        if (text.find(".light_choices = light_choices") != std::string::npos) {
            fill.push_back(file);
        }
    }
    EXPECT_THAT(fill, ElementsAre("world/device_scene.cpp"));
}

} // namespace
} // namespace argand
