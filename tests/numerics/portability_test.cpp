// The same seed gives the same bits however the tool is run. (test_methods, Repeat covers
// lavapipe's threads and each fallback.)
#include "picture_bytes.hpp"
#include "results.hpp"
#include "support/abilities.hpp"
#include "support/scratch_directory.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace argand::testing {
namespace {

struct Run {
    const char* name;
    const char* environment;
    const char* backend;
};

std::string render_with(const Run& run, const std::string& method) {
    const ScratchDirectory directory;
    const std::string output = (directory / "picture.exr").string();
    const std::string command = fmt::format(
        "env {} '{}' render '{}/assets/cornell_glass.glb' -q --backend {} --size 24x16 --spp 2 "
        "--method {}{} -o '{}'",
        run.environment, ARGAND_EXECUTABLE, ARGAND_SOURCE_DIR, run.backend, method,
        has_map(method) ? " --photons 5000" : "", output);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return picture_bytes(output);
}

void expect_same_bits(std::initializer_list<Run> runs) {
    for (const std::string method : {"footprints", "path"}) {
        std::string first;
        for (const Run& run : runs) {
            const std::string found = render_with(run, method);
            EXPECT_FALSE(found.empty());
            first = first.empty() ? found : first;
            EXPECT_TRUE(found == first) << run.name << ", " << method;
        }
    }
    for (const Run& run : runs) {
        record_result(
            "portability",
            {{"backend", run.backend}, {"run", run.name}, {"environment", run.environment}});
    }
}

TEST(Portability, SlowValidationAndSubgroups) {
    expect_same_bits({{"as it is", "ARGAND_VALIDATION=0", "vulkan"},
                      {"validation", "ARGAND_VALIDATION=1", "vulkan"},
                      {"no subgroups", "ARGAND_DISABLE=subgroups", "vulkan"},
                      {"kernels of GPUs, subgroups", "ARGAND_DISABLE=lane_serial", "vulkan"},
                      {"no subgroups, kernels of GPUs, 1 thread",
                       "ARGAND_DISABLE=lane_serial,subgroups LP_NUM_THREADS=1", "vulkan"}});
}

TEST(Portability, ThreadsOfTheHost) {
    expect_same_bits(
        {{"1 thread", "OMP_NUM_THREADS=1", "cpu"}, {"2 threads", "OMP_NUM_THREADS=2", "cpu"}});
}

} // namespace
} // namespace argand::testing
