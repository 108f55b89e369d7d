#include "layering/layering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand::layering {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A small tree without faults that has every kind of allowed include.
Sources good_tree() {
    return {
        {"engine/base/error.hpp", "#include <fmt/format.h>\n"},
        {"engine/image/image.hpp", "#include \"base/error.hpp\"\n"},
        {"engine/scene/scene.hpp", "#include \"shared/records.h\"\n"},
        {"engine/device/device.hpp", "#include \"device/vulkan/memory.hpp\"\n"},
        {"engine/device/vulkan/memory.hpp", "#include \"base/error.hpp\"\n"},
        {"engine/parallel/scan.cpp",
         "#include \"kernels/scan.hpp\"\n#include \"device/device.hpp\"\n"},
        {"engine/accel/tree.hpp", "#include \"shared/records.h\"\n"},
        {"engine/methods/path.cpp", "#include \"accel/tree.hpp\"\n#include \"scene/scene.hpp\"\n"},
        {"shaders/shared/records.h", "#include \"shared/prelude.h\"\n"},
        {"shaders/shared/prelude.h", "#include <cmath>\n"},
        {"shaders/comp/kernel.glsl", "#include \"shared/prelude.h\"\n"},
        {"shaders/comp/accel/trace.comp",
         "#include \"kernel.glsl\"\n#include \"accel/stack.glsl\"\n"},
        {"shaders/comp/accel/stack.glsl", ""},
        {"shaders/comp/photon/emit.comp", ""},
        {"shaders/cuda/kernel.h", "#include \"device/twin.hpp\"\n#include \"shared/prelude.h\"\n"},
        {"shaders/cuda/photon/emit.cu",
         "#include \"cuda/kernel.h\"\n#include \"kernels/emit.twin.h\"\n"},
        {"engine/device/twin.hpp", ""},
        {"tools/argand/main.cpp", "#include \"methods/path.hpp\"\n#include \"options.hpp\"\n"},
        {"tools/argand/options.hpp", ""},
        {"tools/shader_compile/reflect.hpp", ""},
        {"engine/methods/path.hpp", ""},
    };
}

/// Faults after adding an include line to a file of the good tree.
std::vector<std::string> faults_with(const std::string& file, const std::string& include) {
    Sources tree = good_tree();
    tree[file] += "#include " + include + "\n";
    return faults(tree);
}

TEST(Layering, AcceptsATreeWithoutFaults) { EXPECT_THAT(faults(good_tree()), IsEmpty()); }

TEST(Layering, FindsAnIncludeOfAHigherLevel) {
    EXPECT_THAT(
        faults_with("engine/accel/tree.hpp", "\"methods/path.hpp\""),
        ElementsAre(
            "engine/accel/tree.hpp:2: includes methods/path.hpp: methods stands above accel"));
    EXPECT_THAT(faults_with("engine/base/error.hpp", "\"image/image.hpp\""),
                Contains(HasSubstr("above base")));
    EXPECT_THAT(faults_with("engine/methods/path.cpp", "\"argand/options.hpp\""),
                ElementsAre(HasSubstr("tools/argand stands above methods")));
}

TEST(Layering, FindsAnIncludeWithinALevel) {
    EXPECT_THAT(faults_with("engine/scene/scene.hpp", "\"image/image.hpp\""),
                ElementsAre(HasSubstr("scene and image stand side by side")));
    EXPECT_THAT(faults_with("tools/argand/main.cpp", "\"shader_compile/reflect.hpp\""),
                ElementsAre(HasSubstr("stand side by side")));
}

TEST(Layering, ResolvesEverySpellingOfAPath) {
    for (const std::string spelling :
         {"<image/image.hpp>", "\"../image/image.hpp\"", "  \"image/image.hpp\" // why"})
        EXPECT_THAT(faults_with("engine/scene/scene.hpp", spelling),
                    ElementsAre(HasSubstr("side by side")))
            << spelling;
    Sources tree = good_tree();
    tree["engine/scene/scene.hpp"] += "\t#  include\t\"image/image.hpp\"\n";
    EXPECT_THAT(faults(tree), ElementsAre(HasSubstr("side by side")));
}

TEST(Layering, KeepsTheSharedMathsAndTheKernelsApart) {
    EXPECT_THAT(faults_with("shaders/shared/records.h", "\"base/error.hpp\""),
                ElementsAre(HasSubstr("only itself")));
    EXPECT_THAT(faults_with("engine/image/image.hpp", "\"shared/records.h\""),
                ElementsAre(HasSubstr("for scene")));
    EXPECT_THAT(faults_with("engine/base/error.hpp", "\"shared/records.h\""),
                ElementsAre(HasSubstr("for scene")));
    EXPECT_THAT(faults_with("engine/scene/scene.hpp", "\"kernels/scan.hpp\""),
                ElementsAre(HasSubstr("for device")));
    EXPECT_THAT(faults_with("shaders/comp/photon/emit.comp", "\"accel/stack.glsl\""),
                ElementsAre(HasSubstr("their own folder")));
    EXPECT_THAT(faults_with("shaders/comp/photon/emit.comp", "\"base/error.hpp\""),
                ElementsAre(HasSubstr("their own folder")));
    EXPECT_THAT(faults_with("shaders/comp/photon/emit.comp", "\"shared/records.h\""), IsEmpty());
    EXPECT_THAT(faults_with("shaders/raster/photon/show.vert", "\"kernel.glsl\""), IsEmpty());
    EXPECT_THAT(faults_with("shaders/raster/photon/show.vert", "\"accel/stack.glsl\""),
                ElementsAre(HasSubstr("kernels see only")));
    EXPECT_THAT(faults_with("shaders/cuda/photon/emit.cu", "\"methods/path.hpp\""),
                ElementsAre(HasSubstr("twins see only")));
    EXPECT_THAT(faults_with("shaders/cuda/photon/emit.cu", "\"comp/kernel.glsl\""),
                ElementsAre(HasSubstr("twins see only")));
    EXPECT_THAT(faults_with("shaders/cuda/photon/emit.cu", "\"shared/records.h\""), IsEmpty());
}

TEST(Layering, FindsFilesThatIncludeEachOther) {
    EXPECT_THAT(faults_with("engine/device/vulkan/memory.hpp", "\"device/device.hpp\""),
                ElementsAre("files include each other: engine/device/device.hpp > "
                            "engine/device/vulkan/memory.hpp > "
                            "engine/device/device.hpp"));
    EXPECT_THAT(faults_with("tools/argand/options.hpp", "\"options.hpp\""),
                ElementsAre(HasSubstr("options.hpp > tools/argand/options.hpp")));
}

TEST(Layering, FindsFilesOutsideAllLayers) {
    EXPECT_THAT(faults_with("engine/base/error.hpp", "\"bse/text.hpp\""),
                ElementsAre(HasSubstr("no such file")));
    Sources tree = good_tree();
    tree["engine/helpers/all.hpp"] = "#include \"base/error.hpp\"\n";
    EXPECT_THAT(faults(tree), ElementsAre(HasSubstr("helpers has no place")));
    tree = good_tree();
    tree["engine/helpers/all.hpp"] = "";
    tree["engine/accel/tree.hpp"] += "#include \"helpers/all.hpp\"\n";
    EXPECT_THAT(faults(tree), ElementsAre(HasSubstr("helpers has no place")));
}

TEST(Layering, ThisRepositoryHasNoFaults) {
    const Sources sources = read_sources(ARGAND_SOURCE_DIR, {"engine", "shaders", "tools"});
    ASSERT_TRUE(sources.contains("engine/base/error.hpp"));
    ASSERT_TRUE(sources.contains("shaders/shared/prelude.h"));
    std::set<std::string> arrows;
    for (const Include& include : includes(sources))
        arrows.insert(part_of(include.file) + " to " + part_of(include.target));
    EXPECT_TRUE(arrows.contains("device to base") && arrows.contains("comp to shared"))
        << "includes are not read";
    EXPECT_THAT(faults(sources), IsEmpty());
}

} // namespace
} // namespace argand::layering
