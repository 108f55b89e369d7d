#include "command_line.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "commands.hpp"
#include "device/validation.hpp"
#include "picture_options.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

namespace argand {

namespace {

constexpr int failure = 1;
constexpr int usage = 2;

/// Says what is wrong with the command line, and where to look it up.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) {
        return fmt::format("there is no {} '{}'; `argand --help` lists the commands",
                           unknown.front().front() == '-' ? "option" : "command", unknown.front());
    }
    const std::string command =
        app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name() + " ";
    return fmt::format("{}; `argand {}--help` says what there is", error.what(), command);
}

/// Never throws, even if the standard error is closed or on a full disk.
void complain(const std::string& message) {
    std::fputs(("argand: " + message + "\n").c_str(), stderr);
}

/// Flushes the standard output. Returns false, with a message, if any of it could not be written.
/// `code`: the errno of an earlier failure to write, or 0.
bool printed(int code) {
    if (std::fflush(stdout) != 0 && code == 0) {
        code = errno;
    }
    if (code == 0 && std::ferror(stdout) == 0) {
        return true;
    }
    complain(fmt::format("writing to the standard output: {}; send it elsewhere",
                         code != 0 ? std::strerror(code) : "not all of it could be written"));
    return false;
}

/// Prints the messages of the API's validation. Returns false if there are any.
bool validated() {
    const std::vector<std::string> messages = all_validation_messages();
    for (const std::string& message : messages) {
        complain("validation: " + one_line(message, 4096));
    }
    return messages.empty();
}

int parse_and_run(int argc, const char* const* argv, MethodTable methods, ShowInWindow window) {
    CLI::App app("Argand: a photon-mapping renderer for any Vulkan GPU. Reads glTF 2.0, writes PNG "
                 "and OpenEXR.");
    app.name("argand");
    app.set_version_flag("--version", "argand " ARGAND_VERSION);
    app.require_subcommand(1);
    app.footer("Example:\n  argand render assets/cornell_glass.glb -o picture.png\n\n"
               "`argand COMMAND --help` describes each command.");
    add_render_command(app, methods, command_text(argc, argv));
    add_view_command(app, methods, {argv, static_cast<std::size_t>(argc)}, window);
    add_compare_command(app);
    add_compare_backends_command(app, methods);
    add_tradeoff_command(app, methods);
    add_inspect_command(app, methods);
    add_devices_command(app);
    add_bench_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            return app.exit(error);
        }
        complain(complaint(app, error));
        return usage;
    }
    return 0;
}

/// Returns the exit status, and in `output_error` the errno of a failure to print.
int run(int argc, const char* const* argv, MethodTable methods, ShowInWindow window,
        int& output_error) {
    try {
        return parse_and_run(argc, argv, methods, window);
    } catch (const UsageError& error) {
        complain(error.what());
        return usage;
    } catch (const Error& error) {
        complain(error.what());
    } catch (const std::bad_alloc&) {
        complain("the machine is out of memory; ask for a smaller picture or fewer photons");
    } catch (const std::exception& error) {
        const auto* system = dynamic_cast<const std::system_error*>(&error);
        if (system && std::ferror(stdout) != 0) {
            output_error = system->code().value();
        } else {
            complain(fmt::format("unexpected failure ({}); please report it", error.what()));
        }
    }
    return failure;
}

} // namespace

int run_command_line(int argc, const char* const* argv, MethodTable methods, ShowInWindow window) {
    int output_error = 0;
    const int code = run(argc, argv, methods, window, output_error);
    const bool all_printed = printed(output_error);
    const bool is_valid = validated();
    return code == 0 && !(all_printed && is_valid) ? failure : code;
}

} // namespace argand
