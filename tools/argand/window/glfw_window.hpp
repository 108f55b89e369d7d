#pragma once

#include "device/vulkan/instance.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <array>
#include <string>
#include <utility>
#include <vector>
#include <volk.h>

namespace argand::window {

/// A window of the desktop.
class GlfwWindow {
public:
    /// Throws Error if there is no display.
    GlfwWindow(const std::string& title, int width, int height);
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;
    ~GlfwWindow();

    GLFWwindow* handle() const { return window_; }
    /// Throws Error if the instance cannot draw on it.
    VkSurfaceKHR make_surface(const vulkan::Instance& instance) const;
    /// In pixels, which may be smaller than the units of the desktop.
    VkExtent2D framebuffer() const;
    bool should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

    /// Handles what the user has done. Returns whether any of it, since the last call, is likely to
    /// change the scene.
    bool poll();
    /// The same, but waits until the user does something, for so many seconds at most.
    bool wait(double seconds);
    /// Keys that were pressed since the last call, with their modifiers, however short.
    std::vector<std::pair<int, int>> take_pressed() { return std::exchange(pressed_, {}); }
    /// Tells which part of the window, in its units, belongs to the panel.
    void set_panel(double x0, double y0, double x1, double y1) { panel_ = {x0, y0, x1, y1}; }
    /// Files that were dropped on it since the last call.
    std::vector<std::string> take_dropped() { return std::exchange(dropped_, {}); }

private:
    void install_callbacks();
    bool pointer_is_on_panel() const;

    GLFWwindow* window_ = nullptr;
    std::array<double, 4> panel_{};
    bool touched_ = false;
    std::vector<std::pair<int, int>> pressed_;
    std::vector<std::string> dropped_;
};

} // namespace argand::window
