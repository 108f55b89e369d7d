#include "glfw_window.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <imgui.h>

namespace argand::window {

namespace {

std::string last_problem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? one_line(text, 120) : "no reason is given";
}

bool changes_view(int key) {
    constexpr std::array keys{GLFW_KEY_W,     GLFW_KEY_A,  GLFW_KEY_S,  GLFW_KEY_D,
                              GLFW_KEY_Q,     GLFW_KEY_E,  GLFW_KEY_UP, GLFW_KEY_DOWN,
                              GLFW_KEY_SPACE, GLFW_KEY_F5, GLFW_KEY_Z};
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

} // namespace

GlfwWindow::GlfwWindow(const std::string& title, int width, int height) {
    if (glfwInit() != GLFW_TRUE) {
        fail("opening a window: there is no display ({}); use --headless with --script FILE",
             last_problem());
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
        int x = 0, y = 0, most_width = 0, most_height = 0;
        glfwGetMonitorWorkarea(monitor, &x, &y, &most_width, &most_height);
        width = most_width > 0 ? std::min(width, most_width) : width;
        height = most_height > 0 ? std::min(height, most_height) : height;
    }
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string problem = last_problem();
        glfwTerminate();
        fail("opening a window: {}; use --headless with --script FILE", problem);
    }
    glfwSetWindowUserPointer(window_, this);
    install_callbacks();
}

GlfwWindow::~GlfwWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool GlfwWindow::pointer_is_on_panel() const {
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    return x >= panel_[0] && y >= panel_[1] && x < panel_[2] && y < panel_[3];
}

/// Dear ImGui's own callbacks, which are installed later, call these. What goes to the panel, and
/// keys that do not change the view, wait for the end of a pass, which they need not spoil.
void GlfwWindow::install_callbacks() {
    static constexpr auto of = [](GLFWwindow* window) {
        return static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
    };
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        if (action == GLFW_PRESS) {
            of(w)->pressed_.emplace_back(key, modifiers);
            of(w)->touched_ |= changes_view(key) && !ImGui::GetIO().WantCaptureKeyboard;
        }
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int action, int) {
        of(w)->touched_ |= action == GLFW_PRESS && !of(w)->pointer_is_on_panel();
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) {
        of(w)->touched_ |= !of(w)->pointer_is_on_panel();
    });
    // A pointer that only hovers must not end the passes of the picture at rest.
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) {
        for (int button = GLFW_MOUSE_BUTTON_LEFT; button <= GLFW_MOUSE_BUTTON_MIDDLE; ++button) {
            of(w)->touched_ |= glfwGetMouseButton(w, button) == GLFW_PRESS &&
                               (!of(w)->pointer_is_on_panel() || ImGui::IsAnyItemActive());
        }
    });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) { of(w)->touched_ = true; });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
        of(w)->touched_ = true;
        of(w)->dropped_.assign(files, files + count);
    });
}

VkSurfaceKHR GlfwWindow::make_surface(const vulkan::Instance& instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(instance.handle(), window_, nullptr, &surface) != VK_SUCCESS) {
        fail("opening a window: Vulkan cannot draw on this display ({}); use --headless with "
             "--script FILE",
             last_problem());
    }
    return surface;
}

VkExtent2D GlfwWindow::framebuffer() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

bool GlfwWindow::poll() {
    glfwPollEvents();
    return std::exchange(touched_, false);
}

bool GlfwWindow::wait(double seconds) {
    glfwWaitEventsTimeout(seconds);
    return std::exchange(touched_, false);
}

} // namespace argand::window
