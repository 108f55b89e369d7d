#pragma once

#include "swapchain.hpp"
#include "texture.hpp"
#include "ui_pipeline.hpp"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace argand::window {

/// A picture of 8 bits a channel, RGBA, as a display shows it.
struct ShownPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> texels; ///< width × height × 4
};

/// Shows Dear ImGui's lists, and a picture that they may draw, on a surface. Two frames are in
/// flight: while the display shows one, the next one is recorded.
class Presenter {
public:
    /// Owns the surface. font: the atlas of Dear ImGui. Throws Error if nothing can draw on the
    /// surface.
    Presenter(std::shared_ptr<vulkan::Instance> instance, VkSurfaceKHR surface,
              const ShownPicture& font);
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;
    ~Presenter();

    /// The texture of the font, and of the picture in the next frame.
    ImTextureID font() const { return font_set_; }
    ImTextureID picture() const { return frames_[next_].picture_set; }
    /// The most pixels on a side of a picture.
    int most_side() const { return most_side_; }
    /// Another picture, from the next frame on.
    void set_picture(ShownPicture picture);

    /// Shows the lists in a window of this size in pixels; nothing if it is minimised. Throws Error
    /// if the surface or the device is lost: make another presenter.
    void present(const ImDrawData& lists, VkExtent2D size);

private:
    struct Frame {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence done = VK_NULL_HANDLE;
        VkSemaphore acquired = VK_NULL_HANDLE;
        std::unique_ptr<HostBuffer> vertices, indices;
        std::unique_ptr<Texture> picture;
        VkDescriptorSet picture_set = VK_NULL_HANDLE;
        std::uint64_t picture_version = 0;
    };
    /// Destroys the surface after everything that uses it.
    struct Surface {
        std::shared_ptr<vulkan::Instance> instance;
        VkSurfaceKHR handle;
        ~Surface();
    };
    void make_frame(Frame& frame);
    void upload_picture(Frame& frame);
    void record(Frame& frame, const ImDrawData& lists, std::uint32_t image);

    Surface surface_;
    ShowingDevice device_;
    Swapchain swapchain_;
    UiPipeline pipeline_;
    std::unique_ptr<Texture> font_;
    VkDescriptorSet font_set_ = VK_NULL_HANDLE;
    ShownPicture font_texels_; ///< empty once they are uploaded
    int most_side_ = 1;
    ShownPicture picture_;
    std::uint64_t picture_version_ = 0;
    std::array<Frame, 2> frames_;
    std::size_t next_ = 0;
    bool must_resize_ = true;
    VkExtent2D window_{};
};

} // namespace argand::window
