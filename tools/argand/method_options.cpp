#include "method_options.hpp"

#include "base/error.hpp"
#include "methods/render.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace argand {

namespace {

struct MethodOption {
    const char* name;
    std::vector<std::string> methods; ///< that use it
};

/// Options of `argand render` that not every method uses.
std::vector<MethodOption> method_options() {
    const std::vector<std::string> maps{"footprints", "photons", "knn"};
    std::vector<MethodOption> options{{"--k", {"knn"}}};
    for (const char* name : {"--photons", "--radius", "--query-cell", "--wide-codes",
                             "--final-gather", "--photon-sampling", "--leaf-size"}) {
        options.push_back({name, maps});
    }
    for (const char* name :
         {"--smoothing", "--caustic-smoothing", "--max-footprint", "--flatness", "--uniform-kernel",
          "--fixed-smoothing", "--paper-axes", "--paper-reemission"}) {
        options.push_back({name, {"footprints"}});
    }
    return options;
}

} // namespace

void check_methods(const std::vector<std::string>& names) {
    const std::vector<std::string> known = method_names();
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            throw UsageError(
                fmt::format("choosing method '{}': choose from {}", name, fmt::join(known, ", ")));
        }
    }
}

void check_method_options(const CLI::App& command, const std::string& method) {
    for (const MethodOption& option : method_options()) {
        const bool used =
            std::find(option.methods.begin(), option.methods.end(), method) != option.methods.end();
        if (!used && command.get_option(option.name)->count() > 0) {
            throw UsageError(fmt::format(
                "reading {}: it has no effect with --method {}; it is for {}; leave it out",
                option.name, method, fmt::join(option.methods, ", ")));
        }
    }
}

} // namespace argand
