#include "run_window.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "glfw_window.hpp"
#include "handles.hpp"
#include "image/files.hpp"
#include "image/png.hpp"
#include "interactive/run_script.hpp"
#include "navigation.hpp"
#include "panel.hpp"
#include "presenter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <memory>
#include <utility>

namespace argand::window {

namespace {

namespace fs = std::filesystem;

constexpr int panel_width = 340; ///< with its margins

/// The picture as it is shown: of a side longer than this, only every second texel, or fewer.
ShownPicture shown(const Image& image, const Display& display, int most_side) {
    const std::vector<std::uint8_t> rgb = srgb_bytes(image, display);
    const int step = (std::max(image.width, image.height) + most_side - 1) / most_side;
    ShownPicture picture{.width = (image.width + step - 1) / step,
                         .height = (image.height + step - 1) / step,
                         .texels = {}};
    picture.texels.reserve(4 * static_cast<std::size_t>(picture.width) *
                           static_cast<std::size_t>(picture.height));
    for (int y = 0; y < image.height; y += step) {
        for (int x = 0; x < image.width; x += step) {
            const auto i =
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x));
            picture.texels.insert(picture.texels.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
        }
    }
    return picture;
}

/// Where the panel's layout is remembered; empty: nowhere.
std::string settings_file() {
    const char* config = std::getenv("XDG_CONFIG_HOME"); // NOLINT(concurrency-mt-unsafe)
    const char* home = std::getenv("HOME");              // NOLINT(concurrency-mt-unsafe)
    if (!config && !home) {
        return "";
    }
    const fs::path folder = (config ? fs::path(config) : fs::path(home) / ".config") / "argand";
    std::error_code problem; // then nothing is remembered
    fs::create_directories(folder, problem);
    return problem ? "" : (folder / "view.ini").string();
}

/// Dear ImGui, fed by a window.
class Interface {
public:
    explicit Interface(const GlfwWindow& window) : settings_(settings_file()) {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = settings_.empty() ? nullptr : settings_.c_str();
        ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
        ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    }
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    ~Interface() {
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }

    static ShownPicture font() {
        unsigned char* texels = nullptr;
        ShownPicture picture;
        ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &picture.width, &picture.height);
        picture.texels.assign(texels, texels + static_cast<std::ptrdiff_t>(4) * picture.width *
                                                   picture.height);
        return picture;
    }

private:
    std::string settings_; ///< Dear ImGui keeps a pointer to it
};

/// The file's time of change, if it has one.
fs::file_time_type time_of(const std::string& file) {
    std::error_code problem;
    const fs::file_time_type time = fs::last_write_time(file, problem);
    return problem ? fs::file_time_type() : time;
}

class ViewWindow {
public:
    ViewWindow(View& view, const WindowStart& start)
        : view_(view), start_(start),
          window_("argand: " + view.file(), std::max(view.settings().width, 320) + panel_width,
                  std::max(view.settings().height, 480)),
          interface_(window_), instance_(vulkan::instance()),
          changed_on_disk_(time_of(view.file())) {
        state_.picture = start.picture;
        open_presenter();
    }

    /// Until the user closes the window.
    void run() {
        while (!window_.should_close() && !interrupted()) {
            follow_user();
            ViewFrame frame;
            if (!attempt(state_, [&] { frame = view_.frame([&] { return !window_.poll(); }); })) {
                frame = view_.frame(); // of what was there before
            }
            if (frame.picture != state_.frame.picture) {
                start_.on_frame(frame, "");
            }
            // A picture that is complete only waits for the user.
            if (frame.picture == state_.frame.picture) {
                window_.wait(0.05);
            } else {
                window_.poll();
            }
            show(frame);
        }
    }

    void run(const Script& script) {
        run_script(view_, script,
                   {.screenshot = [&](View&, const std::string& file) { write_picture(file); },
                    .on_frame =
                        [&](const ViewFrame& frame, const std::string& error) {
                            state_.message = error;
                            start_.on_frame(frame, error);
                            window_.poll();
                            show(frame);
                        },
                    .stops = [&] { return window_.should_close() || interrupted(); }});
    }

private:
    void open_presenter() {
        presenter_.reset();
        presenter_ = std::make_unique<Presenter>(instance_, window_.make_surface(*instance_),
                                                 Interface::font());
        ImGui::GetIO().Fonts->SetTexID(presenter_->font());
        shows_ = false;
    }

    void write_picture(const std::string& file) {
        const std::vector<Layer> layers = view_.layers();
        write_image(file, layers,
                    picture_settings(state_.picture, view_.settings(), view_.picture()));
    }

    /// Files of a scene are named after it, with the first number that is free.
    std::string free_name(const std::string& extension) const {
        const std::string stem = fs::path(view_.file()).stem().string();
        for (int i = 0;; ++i) {
            std::string name = fmt::format("{}_{:03}{}", stem, i, extension);
            if (!fs::exists(name)) {
                return name;
            }
        }
    }

    std::string edits_file() const {
        return fs::path(view_.file()).stem().string() + ".edits.json";
    }

    /// Shows another file, or the same one as it is now.
    void open(const std::string& file) {
        state_.message.clear();
        const bool is_other = file != view_.file();
        if (!attempt(state_, [&] { view_.open(file); })) {
            return;
        }
        changed_on_disk_ = time_of(file);
        handles_.forget();
        if (is_other) {
            glfwSetWindowTitle(window_.handle(), ("argand: " + file).c_str());
            navigation_.forget();
            state_.undo.clear();
            state_.plays = false;
        }
    }

    /// Applies what the user did since the last frame.
    void follow_user() {
        for (const std::string& file : window_.take_dropped()) {
            open(file);
        }
        const fs::file_time_type changed = time_of(view_.file());
        if (changed != changed_on_disk_ && changed != fs::file_time_type()) {
            changed_on_disk_ = changed; // tried once, even if it cannot be read
            open(view_.file());
        }
        if (const double longest = longest_animation(view_.scene()); state_.plays && longest > 0) {
            const double seconds = view_.time().value_or(0) + double(ImGui::GetIO().DeltaTime);
            attempt(state_, [&] { view_.set_time(std::fmod(seconds, longest)); });
        }
    }

    void on_keys() {
        const bool typing = ImGui::GetIO().WantCaptureKeyboard;
        for (const auto& [key, modifiers] : window_.take_pressed()) {
            if (!typing) {
                on_key(key, modifiers);
            }
        }
    }

    void on_key(int key, int modifiers) {
        if (key == GLFW_KEY_SPACE) {
            state_.plays = !state_.plays && longest_animation(view_.scene()) > 0;
        } else if (key == GLFW_KEY_TAB) {
            shows_panel_ = !shows_panel_;
        } else if (key == GLFW_KEY_F5) {
            open(view_.file());
        } else if (key == GLFW_KEY_Z && (modifiers & GLFW_MOD_CONTROL) != 0) {
            undo(view_, state_);
        } else if (key == GLFW_KEY_F2) {
            save_pictures();
        }
    }

    void save_pictures() {
        const std::string png = free_name(".png");
        if (attempt(state_, [&] {
                write_picture(png);
                write_picture(fs::path(png).replace_extension(".exr").string());
            })) {
            state_.message = "saved " + png + " and .exr";
        }
    }

    void save_edits() {
        if (attempt(state_, [&] { write_json(edits_file(), view_.edits()); })) {
            state_.message = "saved " + edits_file();
        }
    }

    /// Draws the picture as large as fits, in the middle of what the panel leaves.
    void draw_picture() {
        const ImVec2 window = ImGui::GetIO().DisplaySize;
        const float left = shows_panel_ ? std::min(float(panel_width), window.x / 2) : 0;
        const auto width = static_cast<float>(view_.picture().width);
        const auto height = static_cast<float>(view_.picture().height);
        const float scale = std::min((window.x - left) / width, window.y / height);
        low_ = {left + (window.x - left - scale * width) / 2, (window.y - scale * height) / 2};
        high_ = {low_.x + scale * width, low_.y + scale * height};
        ImGui::GetBackgroundDrawList()->AddImage(presenter_->picture(), low_, high_);
    }

    /// Applies what the user drags in the picture: objects, else the camera.
    void follow_pointer() {
        std::optional<nlohmann::json> dragged;
        if (shows_panel_) {
            dragged = handles_.drag(view_, low_, high_);
        } else {
            handles_.release();
        }
        if (handles_.begins()) {
            remember(view_, state_);
        }
        if (dragged) {
            attempt(state_, [&] { view_.edit(*dragged); });
        }
        const std::optional<nlohmann::json> moved = navigation_.move(view_, !handles_.drags());
        if (moved && navigation_.begins()) {
            remember(view_, state_);
        }
        if (moved) {
            attempt(state_, [&] { view_.edit(*moved); });
        }
    }

    /// Shows a frame with the panel over it, which may change the view.
    void show(const ViewFrame& frame) {
        const bool is_new = !shows_ || frame.picture != state_.frame.picture;
        state_.frame = frame;
        if (is_new) {
            presenter_->set_picture(
                shown(view_.picture(),
                      picture_settings(state_.picture, view_.settings(), view_.picture()).display,
                      presenter_->most_side()));
            shows_ = true;
        }
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        draw_picture();
        PanelWishes wishes;
        if (shows_panel_) {
            wishes = draw_panel(view_, state_);
        }
        const std::array<float, 4> panel = wishes.rectangle;
        window_.set_panel(panel[0], panel[1], panel[2], panel[3]);
        shows_ = shows_ && !wishes.changes_display;
        on_keys();
        follow_pointer();
        if (wishes.screenshot) {
            save_pictures();
        }
        if (wishes.save_edits) {
            save_edits();
        }
        if (wishes.copy_command) {
            ImGui::SetClipboardText(start_.command(view_, edits_file(), state_.picture).c_str());
        }
        ImGui::Render();
        try {
            presenter_->present(*ImGui::GetDrawData(), window_.framebuffer());
        } catch (const Error&) {
            // The surface or the device was lost; the picture is not, and the next frame shows it.
            open_presenter();
        }
    }

    View& view_;
    const WindowStart& start_;
    GlfwWindow window_;
    Interface interface_;
    std::shared_ptr<vulkan::Instance> instance_;
    std::unique_ptr<Presenter> presenter_;
    Navigation navigation_;
    Handles handles_;
    ImVec2 low_{}, high_{}; ///< corners of the picture in the window
    PanelState state_;
    fs::file_time_type changed_on_disk_;
    bool shows_ = false; ///< the presenter has the view's picture
    bool shows_panel_ = true;
};

} // namespace

void run_window(View& view, const WindowStart& start) {
    ViewWindow window(view, start);
    if (start.script) {
        window.run(*start.script);
    } else {
        window.run();
    }
}

} // namespace argand::window
