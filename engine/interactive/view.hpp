#pragma once

#include "base/clock.hpp"
#include "interactive/frame_time.hpp"
#include "scene/scene_editor.hpp"
#include "session/session.hpp"

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// What a view renders, and how fast.
struct ViewSettings {
    RenderSettings still;       ///< of one pass of the picture at rest, of full size
    std::uint32_t passes = 256; ///< of the picture at rest, where its method repeats them
    double frame_seconds = 0.1; ///< that a frame of a moving picture is to take
};

/// A frame of a view.
struct ViewFrame {
    std::uint64_t number = 0;
    bool moving = false;       ///< it is a preview, else the picture at rest
    std::uint64_t passes = 0;  ///< of the picture at rest so far
    int width = 0, height = 0; ///< in which it was rendered
    std::uint64_t photons = 0; ///< of its pass
    double seconds = 0;        ///< that it took
    std::uint64_t picture = 0; ///< counts pictures: equal numbers, the same picture
};

/// A scene that a user looks at and changes. Each frame after a change is a preview, of such a size
/// that it takes ViewSettings::frame_seconds; the others add a pass each to the picture at rest. A
/// change that throws leaves everything as it was.
class View {
public:
    /// Loads the scene of a file, at a moment of its animations, maybe with what edits need to move
    /// nodes (LoadOptions::movable_nodes). Throws Error if it cannot.
    using Load = std::function<Scene(const std::string& file, std::optional<double> seconds,
                                     bool movable_nodes)>;

    /// Shows the scene of a file, as `load` loads it. Keeps a reference to the device. Throws
    /// UsageError on an unknown method.
    View(Device& device, Scene scene, const std::string& file, Load load,
         const ViewSettings& settings, MethodTable methods = builtin_methods());

    // Changes. The next frame shows them.

    /// Shows another scene, as its file states it; the same file again keeps the edits.
    void open(const std::string& file);
    /// Merges edits (scene/edits.hpp) into those so far, as RFC 7386 says: null takes one back.
    void edit(const nlohmann::json& patch);
    /// Replaces all edits.
    void set_edits(nlohmann::json edits);
    /// Moves to a time of the animations; none: to rest.
    void set_time(std::optional<double> seconds);
    void set_method(const std::string& method);
    /// Sets an option of the method to a value, both as on the command line.
    void set_option(const std::string& name, const std::string& value);
    void resize(int width, int height);

    /// Renders a frame. keep_going: asked now and then; once it returns false, a frame at rest is
    /// given up, and the picture stays as it was. Throws Error if the device cannot do it; the view
    /// is then as it was last shown at rest.
    ViewFrame frame(const std::function<bool()>& keep_going = [] { return true; });

    /// The last frame's picture, in full size.
    const Image& picture() const { return picture_; }
    /// The last frame's picture: all layers at rest, else the whole picture only.
    std::vector<Layer> layers();

    const nlohmann::json& edits() const { return edits_; }
    const Scene& scene() const { return *scene_; }
    /// The scene's nodes (Motion::nodes) without edits.
    const std::vector<MotionNode>& unedited_nodes() const { return editor_->unedited_nodes(); }
    const std::string& file() const { return file_; }
    std::optional<double> time() const { return scene_->seconds; }
    MethodTable methods() const { return methods_; }
    /// Of one pass of the picture at rest.
    const RenderSettings& settings() const { return settings_.still; }
    /// Those with which `argand render` makes the picture at rest as it is now.
    RenderSettings equivalent() const;

private:
    void show(Scene scene);
    void apply(const Edits& edits);
    void change_settings(RenderSettings settings);
    bool has_photons() const;
    bool is_progressive_method() const; ///< passes can be repeated without end
    RenderSettings repeated(std::uint32_t passes) const;
    void follow_scene();
    void set_picture(Image picture, std::uint64_t passes);
    void go_back();
    ViewFrame render(const std::function<bool()>& keep_going);
    void preview(ViewFrame& frame, Clock::time_point start);
    void refine(ViewFrame& frame, const std::function<bool()>& keep_going);
    void restart_frame_time();

    Device& device_;
    Load load_;
    ViewSettings settings_;
    MethodTable methods_;
    std::string file_;
    bool movable_nodes_ = false;
    std::unique_ptr<Scene> scene_;
    std::optional<SceneEditor> editor_;
    nlohmann::json edits_ = nlohmann::json::object();
    Edits applied_; ///< the same
    // The sessions keep references to the scene and the world.
    std::unique_ptr<World> world_;             ///< null before the next frame
    std::unique_ptr<Session> preview_, still_; ///< null: the next one that is needed is new
    PreviewSize preview_size_;                 ///< of preview_
    std::optional<FrameTime> frame_time_;
    bool changed_ = true;      ///< since the last frame
    bool is_warm_ = false;     ///< a preview with these settings has compiled its kernels
    bool still_begun_ = false; ///< still_ shows the scene as it is
    std::uint64_t still_passes_ = 0;
    std::uint64_t picture_passes_ = 0; ///< of picture_; 0: it is a preview
    std::uint64_t frames_ = 0, pictures_ = 0;
    /// What was last shown at rest, or first of all.
    struct Shown {
        std::string file;
        bool movable_nodes = false;
        nlohmann::json edits;
        std::optional<double> seconds;
        ViewSettings settings;
    };
    std::optional<Shown> shown_;
    Image picture_;
};

} // namespace argand
