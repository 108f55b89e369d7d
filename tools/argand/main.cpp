#include "base/error.hpp"
#include "commands.hpp"

#include <cstdio>
#include <new>

namespace argand {

namespace {

constexpr int failure = 1;
constexpr int usage = 2;

/// What is wrong with the command line, and where to look it up.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) {
        return fmt::format("there is no {} '{}'; `argand --help` lists the commands",
                           unknown.front().front() == '-' ? "option" : "command", unknown.front());
    }
    const std::string command = app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name() + " ";
    return fmt::format("{}; `argand {}--help` says what there is", error.what(), command);
}

int run(int argc, char** argv) {
    CLI::App app("Argand: a photon-mapping renderer for any Vulkan GPU. Reads glTF 2.0, writes PNG and OpenEXR.");
    app.name("argand");
    app.set_version_flag("--version", "argand " ARGAND_VERSION);
    app.require_subcommand(1);
    app.footer("Example:\n  argand render assets/cornell_glass.glb -o picture.png\n\n"
               "`argand COMMAND --help` says more of each command.");
    add_render_command(app);
    add_compare_command(app);
    add_inspect_command(app);
    add_devices_command(app);
    add_bench_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            return app.exit(error);
        }
        fmt::print(stderr, "argand: {}\n", complaint(app, error));
        return usage;
    }
    return 0;
}

} // namespace

} // namespace argand

int main(int argc, char** argv) {
    try {
        return argand::run(argc, argv);
    } catch (const argand::UsageError& error) {
        fmt::print(stderr, "argand: {}\n", error.what());
        return argand::usage;
    } catch (const argand::Error& error) {
        fmt::print(stderr, "argand: {}\n", error.what());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "argand: the machine is out of memory; ask for a smaller picture or fewer photons\n");
    } catch (const std::exception& error) {
        fmt::print(stderr, "argand: unexpected failure ({}); please report it\n", error.what());
    }
    return argand::failure;
}
