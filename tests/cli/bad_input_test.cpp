// On any wrong input the tool prints one line, leaves no half-written file and does not crash.
#include "argand_run.hpp"

#include <fmt/format.h>

namespace argand::testing {
namespace {

using BadInput = ArgandTest;

TEST_F(BadInput, ScenesThatCannotBeRead) {
    expect_failure("render missing.glb", failure, "missing.glb");
    expect_failure("inspect missing.glb", failure, "missing.glb");
    expect_failure("render .", failure, "'.'");
    write_text(file("empty.glb"), "");
    expect_failure("render empty.glb", failure, "empty.glb");
    write_text(file("bad.gltf"), "{\"asset\": {\"version\": \"2.0\"},");
    expect_failure("render bad.gltf", failure, "bad.gltf");
    write_text(file("nothing.gltf"), R"({"asset": {"version": "2.0"}})");
    expect_failure("render nothing.gltf", failure, "nothing.gltf");
    const std::string whole = read_text(asset("cornell_point.glb"));
    for (const std::size_t length :
         {std::size_t(11), std::size_t(100), whole.size() / 2, whole.size() - 1}) {
        write_text(file("truncated.glb"), whole.substr(0, length));
        expect_failure("render truncated.glb", failure, "truncated.glb");
    }
}

TEST_F(BadInput, SceneWithoutArea) {
    // Three vertices at the same point.
    write_text(file("flat.gltf"),
               R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [0, 0, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
                   std::string(48, 'A') + R"("}]})");
    expect_failure("render flat.gltf --size 8x8", failure, "flat.gltf");
}

TEST_F(BadInput, OutputsThatCannotBeWritten) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x8 ";
    expect_failure(scene + "-o missing/picture.png", failure, "missing");
    expect_failure(scene + "-o picture.jpg", usage, "picture.jpg");
    expect_failure(scene + "-o .", usage, ".png");
    expect_failure(scene + "-o good.png -o missing/bad.exr", failure, "missing");
    expect_failure(scene + "-o good.png --json missing/report.json", failure, "missing");
    expect_failure("render missing.glb -o picture.png", failure, "missing.glb");
}

TEST_F(BadInput, Usage) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' ";
    expect_failure("", usage, "--help");
    expect_failure("paint", usage, "'paint'");
    expect_failure("paint scene.glb -o picture.png", usage, "'paint'");
    expect_failure("paint", usage, "argand --help");
    expect_failure("--fast", usage, "'--fast'");
    expect_failure("render", usage, "scene");
    expect_failure(scene + "--unknown", usage, "--unknown");
    for (const char* size :
         {"0x0", "0x8", "8x0", "8", "8x", "x8", "8x8x8", "-8x8", "8.5x8", "eightxeight",
          "1000000x8", "99999999999999999999x8", "''", "'8 x8'"}) {
        expect_failure(scene + "--size " + size, usage, "--size");
    }
    expect_failure(scene + "--method rays", usage, "photons, ");
    expect_failure(scene + "--backend glide", usage, "vulkan");
    expect_failure("compare", usage, "a");
    expect_failure("inspect", usage, "scene");
}

TEST_F(BadInput, OptionsThatTheMethodDoesNotUse) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --method ";
    for (const char* option :
         {"--photons 100", "--radius 0.1", "--query-cell 0.2", "--wide-codes", "--final-gather",
          "--photon-sampling random", "--leaf-size 8", "--k 50", "--caustic-k 50"}) {
        expect_failure(scene + "path " + option, usage, "knn");
        expect_failure(scene + "path " + option, usage, "no effect with --method path");
    }
    expect_failure(scene + "footprints --k 50", usage, "--k");
    expect_failure(scene + "photons --caustic-k 50", usage, "--caustic-k");
    expect_failure(scene + "knn --caustic-k 0", usage, "--caustic-k");
    expect_failure(scene + "photons --k 50", usage, "--k");
    expect_failure(scene + "path --aperture -0.1", usage, "--aperture");
    expect_failure(scene + "path --focus 2", usage, "--aperture");
    expect_failure(scene + "path --aperture nan", usage, "--aperture");
    expect_failure(scene + "path --aperture 0.1 --focus 0", usage, "--focus");
    expect_failure(scene + "path --aperture 0.1 --focus near", usage, "--focus");
    for (const char* option :
         {"--smoothing 1", "--caustic-smoothing 1", "--max-footprint 1", "--flatness 0.3",
          "--uniform-kernel", "--fixed-smoothing", "--paper-axes", "--paper-reemission"}) {
        for (const char* method : {"photons", "knn", "path"}) {
            expect_failure(scene + method + " " + option, usage, "it is for footprints");
        }
    }
}

TEST_F(BadInput, KdTreesThatAreNone) {
    const std::string scene =
        "render '" + asset("cornell_point.glb") + "' --size 8x8 --spp 1 --photons 100 ";
    expect_failure(scene + "--tracer octree", usage, "--tracer");
    expect_failure(scene + "--tree-memory 100000", usage, "without --tracer kdtree");
    expect_failure(scene + "--tracer kdtree --tree-memory 0", usage, "--tree-memory");
    expect_failure(scene + "--tracer kdtree --tree-memory 100", failure, "does not hold one leaf");
}

TEST_F(BadInput, QueuesThatAreNone) {
    const std::string scene =
        "render '" + asset("cornell_point.glb") + "' --size 8x8 --method photon-queue ";
    for (const char* option :
         {"--window 0", "--window -1", "--window 129", "--half-life 0", "--half-life -2",
          "--half-life nan", "--estimator median", "--rebuild octree", "--classify photons",
          "--direct lights", "--show lights", "--direct photons --final-gather"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        expect_failure(scene + option, usage, name);
    }
    expect_failure(scene + "--photons 20000000 --radius 1", failure, "fewer photons");
}

TEST_F(BadInput, ProgressiveWidthsThatAreNone) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x8 ";
    for (const char* option : {"--passes 0", "--passes 1.5", "--passes -1", "--radius-exponent 0",
                               "--radius-exponent 0.5", "--radius-exponent nan",
                               "--radius-exponent -0.25", "--r1 0", "--r1 -1", "--r1 nan"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        expect_failure(scene + "--progressive " + option, usage, name);
        expect_failure(scene + "--method progressive " + option, usage, name);
    }
    expect_failure(scene + "--method photons --query-leaf 4", usage,
                   "without --query simultaneous");
    expect_failure(scene + "--method photons --query simultaneous --frontier-memory 131071", usage,
                   "from 131072");
    expect_failure(scene + "--method knn --query simultaneous", usage, "--query: it has no effect");
    expect_failure(scene + "--method path --progressive", usage, "--progressive: it has no effect");
    for (const char* option : {"--passes 4", "--r1 0.1", "--radius-exponent 0.2"}) {
        expect_failure(scene + option, usage, "add that");
        expect_failure(scene + "--method path " + option, usage, "no effect with --method path");
    }
    for (const char* option : {"--seed 0", "--seed 3", "--photon-sampling sobol"}) {
        expect_failure(scene + "--deterministic " + option, usage, "nothing random");
    }
    expect_failure(scene + "--progressive --radius 0.1", usage, "--r1");
    expect_failure(scene + "--method progressive --radius 0.1", usage, "--radius");
    expect_failure(scene + "--method footprints --progressive --fixed-smoothing", usage,
                   "--fixed-smoothing");
    expect_failure(scene + "--method progressive --budget 1 --passes 4", usage, "--passes");
    expect_failure(scene + "--progressive --target-error 0.1 --passes 4", usage, "--passes");
    expect_failure(scene + "--method photons --kernel gauss", usage, "--kernel");
    expect_failure(scene + "--method knn --support ball", usage, "it is for photons, progressive");
}

TEST_F(BadInput, NumbersOutOfRange) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' ";
    struct Case {
        const char* option;
        const char* range;
        std::vector<const char*> values;
    };
    for (const Case& c : std::vector<Case>{
             {"--spp",
              "from 1 to 16777216",
              {"0", "-1", "1.5", "many", "nan", "16777217", "99999999999999999999"}},
             {"--photons", "from 0 to 4000000000", {"-1", "1e30", "inf", "0.5", "4000000001"}},
             {"--bounces", "from 0 to 65535", {"-1", "65536", "nan", "few"}},
             {"--radius",
              "from 1e-18 to 1e+18",
              {"0", "-1", "nan", "-nan", "inf", "-inf", "1e-40", "1e999", "wide"}},
             {"--follow-roughness", "from 0 to 1", {"nan", "inf", "-0.1", "1.1", "rough"}},
             {"--seed", "from 0 to 4294967295", {"-1", "4294967296", "nan", "0.5"}},
             {"--at", "from -1000000000 to 1000000000", {"nan", "inf", "later", "1e30"}},
             {"--exposure",
              "from -100 to 100",
              {"nan", "inf", "-inf", "1e30", "101", "much", "1x"}}}) {
        for (const char* value : c.values) {
            const std::string arguments = scene + c.option + " " + value;
            expect_failure(arguments, usage, c.option);
            expect_failure(arguments, usage, fmt::format("'{}' is not a", value));
            expect_failure(arguments, usage, c.range);
        }
    }
}

TEST_F(BadInput, CamerasThatAreNotThere) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --camera ";
    expect_failure(scene + "nobody", failure, "nobody");
    expect_failure(scene + "99", failure, "99");
    expect_failure(scene + "-1", failure, "-1");
}

TEST_F(BadInput, DevicesThatAreNotThere) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x8 ";
    expect_failure(scene + "--device 99", failure, "devices");
    expect_failure(scene + "--device 'no such device'", failure, "no such device");
    expect_failure(scene, failure, "no such device", "ARGAND_DEVICE='no such device'");
    expect_failure(scene, usage, "ARGAND_DISABLE", "ARGAND_DISABLE=everything");
    expect_failure(scene, usage, "ARGAND_LIMIT", "ARGAND_LIMIT=storage_range=little");
    expect_failure(scene, failure, "storage", "ARGAND_LIMIT=storage_range=4KiB");
}

TEST_F(BadInput, NoDriverAndNoLoader) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x8 ";
    const std::string no_driver = "VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent";
    for (const std::string& arguments :
         {scene + "--backend vulkan", std::string("bench parallel --backend vulkan")}) {
        expect_failure(arguments, failure, "there is no device", no_driver);
        expect_failure(arguments, failure, "mesa-vulkan-drivers", no_driver);
        EXPECT_THAT(argand(arguments, no_driver).error,
                    ::testing::Not(::testing::HasSubstr("code")));
    }
    // Empty files with the loader's name hide the real loader.
    const ScratchDirectory libraries;
    write_text(libraries / "libvulkan.so.1", "");
    write_text(libraries / "libvulkan.so", "");
    const std::string no_loader = "LD_LIBRARY_PATH='" + libraries.path().string() + "'";
    expect_failure(scene + "--backend vulkan", failure, "no Vulkan loader", no_loader);
    // If the user names no backend, the tool falls back to the cpu and prints a note.
    for (const std::string& environment : {no_driver, no_loader}) {
        EXPECT_THAT(argand("devices", environment).out, ::testing::HasSubstr("backend cpu"));
        const Outcome run = argand(scene + "--spp 1 -o a.png", environment);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        EXPECT_THAT(run.error, ::testing::HasSubstr("note: using backend cpu"));
    }
}

TEST_F(BadInput, BackendsThatAreNotThere) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x8 ";
    expect_failure(scene + "--backend metal", usage, "'metal': this build has vulkan");
    expect_failure(scene, usage, "'metal': this build has vulkan", "ARGAND_BACKEND=metal");
    expect_failure(scene + "--backend cpu --device llvmpipe", failure, "of backend cpu");
    // A device named by the environment does not apply to a backend named by the user.
    EXPECT_EQ(argand(scene + "--backend cpu -q -o b.png", "ARGAND_DEVICE=llvmpipe").exit_code, 0);
    const std::string compare = "compare-backends '" + asset("cornell_point.glb") + "' ";
    expect_failure(compare + "--b golden", usage, "--golden");
    expect_failure(compare + "--b golden --golden none.golden", failure, "none.golden");
    expect_failure(compare + "--methods magic", usage, "magic");
    expect_failure(compare + "--record /nonexistent/a.golden", failure, "/nonexistent");
}

TEST_F(BadInput, ErrorsThatCannotBeAimedAt) {
    const std::string scene = "render '" + asset("cornell_point.glb") + "' --size 8x8 ";
    expect_failure(scene + "--target-error 0", usage, "--target-error");
    expect_failure(scene + "--target-error nan", usage, "--target-error");
    expect_failure(scene + "--target-error 0.01 --radius 0.1", usage, "--radius");
    expect_failure(scene + "--budget 1 --radius 0.1", usage, "--radius");
    expect_failure(scene + "--target-error 0.01 --method photons --photons 0", usage,
                   "--photons 0");
    expect_failure(scene + "--target-error 0.01 --method footprints --fixed-smoothing", usage,
                   "--fixed-smoothing");
    expect_failure(scene + "--target-error 0.01 --flatness 0.5", usage, "--flatness");
    expect_failure("render '" + asset("ring.glb") +
                       "' --size 8x8 --target-error 0.01 --method path",
                   failure, "leave --method out");
    expect_failure(scene + "--target-error 1e-9", failure, "allow a larger error", on_host);
}

TEST_F(BadInput, PicturesThatCannotBeCompared) {
    const std::string render =
        "render '" + asset("cornell_point.glb") + "' -q --spp 1 --photons 0 ";
    ASSERT_EQ(argand(render + "--size 4x4 -o a.exr", on_host).exit_code, 0);
    ASSERT_EQ(argand(render + "--size 4x6 -o b.exr", on_host).exit_code, 0);
    expect_failure("compare a.exr b.exr", failure, "b.exr");
    expect_failure("compare a.exr missing.exr", failure, "missing.exr");
    expect_failure("compare a.exr a.exr --layer glow", failure, "glow");
    expect_failure("compare a.exr a.exr -o missing/difference.png", failure, "missing");
    write_text(file("bad.exr"), "not a picture");
    expect_failure("compare a.exr bad.exr", failure, "bad.exr");
}

} // namespace
} // namespace argand::testing
