#include "swapchain.hpp"

#include "base/error.hpp"
#include "device/vulkan/result.hpp"

#include <algorithm>

namespace argand::window {

namespace {

using vulkan::check;

constexpr const char* doing = "showing a window";

/// A format that shows colours as they are written: they are encoded already.
VkSurfaceFormatKHR choose_format(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, nullptr), doing);
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, formats.data()), doing);
    const auto usable =
        std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& format) {
            return format.format == VK_FORMAT_B8G8R8A8_UNORM ||
                   format.format == VK_FORMAT_R8G8B8A8_UNORM;
        });
    if (usable == formats.end()) {
        fail("opening a window: the display has no format of 8 bits a channel; use --headless with "
             "--script FILE");
    }
    return *usable;
}

VkRenderPass make_pass(VkDevice device, VkFormat format) {
    VkAttachmentDescription attachment{};
    attachment.format = format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    // The image is cleared after it has been acquired, which the submission waits for at this
    // stage.
    VkSubpassDependency dependency{};
    dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
    dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    dependency.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    dependency.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    VkRenderPassCreateInfo create{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    create.attachmentCount = 1;
    create.pAttachments = &attachment;
    create.subpassCount = 1;
    create.pSubpasses = &subpass;
    create.dependencyCount = 1;
    create.pDependencies = &dependency;
    VkRenderPass pass = VK_NULL_HANDLE;
    check(vkCreateRenderPass(device, &create, nullptr, &pass), doing);
    return pass;
}

} // namespace

Swapchain::Swapchain(const ShowingDevice& device, VkSurfaceKHR surface)
    : device_(device), surface_(surface), format_(choose_format(device.physical, surface)),
      pass_(make_pass(device.device, format_.format)) {}

Swapchain::~Swapchain() {
    vkDeviceWaitIdle(device_.device);
    release_images();
    vkDestroySwapchainKHR(device_.device, swapchain_, nullptr);
    vkDestroyRenderPass(device_.device, pass_, nullptr);
}

void Swapchain::release_images() {
    for (const Image& image : images_) {
        vkDestroyFramebuffer(device_.device, image.framebuffer, nullptr);
        vkDestroyImageView(device_.device, image.view, nullptr);
        vkDestroySemaphore(device_.device, image.drawn, nullptr);
    }
    images_.clear();
}

bool Swapchain::resize(VkExtent2D size) {
    vkDeviceWaitIdle(device_.device);
    release_images();
    VkSurfaceCapabilitiesKHR can;
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical, surface_, &can), doing);
    const bool decides = can.currentExtent.width == UINT32_MAX; // the window does, not the surface
    extent_ =
        decides
            ? VkExtent2D{std::clamp(size.width, can.minImageExtent.width, can.maxImageExtent.width),
                         std::clamp(size.height, can.minImageExtent.height,
                                    can.maxImageExtent.height)}
            : can.currentExtent;
    if (size.width == 0 || size.height == 0 || extent_.width == 0 || extent_.height == 0) {
        vkDestroySwapchainKHR(device_.device, swapchain_, nullptr);
        swapchain_ = VK_NULL_HANDLE;
        return false;
    }
    VkSwapchainCreateInfoKHR create{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    create.surface = surface_;
    create.minImageCount = can.maxImageCount == 0
                               ? can.minImageCount + 1
                               : std::min(can.minImageCount + 1, can.maxImageCount);
    create.imageFormat = format_.format;
    create.imageColorSpace = format_.colorSpace;
    create.imageExtent = extent_;
    create.imageArrayLayers = 1;
    create.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    create.preTransform = can.currentTransform;
    create.compositeAlpha = (can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                                ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    create.presentMode = VK_PRESENT_MODE_FIFO_KHR; // every device has it
    create.clipped = VK_TRUE;
    create.oldSwapchain = swapchain_;
    VkSwapchainKHR made = VK_NULL_HANDLE;
    check(vkCreateSwapchainKHR(device_.device, &create, nullptr, &made), doing);
    vkDestroySwapchainKHR(device_.device, swapchain_, nullptr);
    swapchain_ = made;
    std::uint32_t count = 0;
    check(vkGetSwapchainImagesKHR(device_.device, swapchain_, &count, nullptr), doing);
    std::vector<VkImage> images(count);
    check(vkGetSwapchainImagesKHR(device_.device, swapchain_, &count, images.data()), doing);
    for (const VkImage image : images) {
        add(image);
    }
    return true;
}

void Swapchain::add(VkImage image) {
    Image& added = images_.emplace_back();
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    check(vkCreateImageView(device_.device, &view, nullptr, &added.view), doing);
    VkFramebufferCreateInfo framebuffer{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    framebuffer.renderPass = pass_;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &added.view;
    framebuffer.width = extent_.width;
    framebuffer.height = extent_.height;
    framebuffer.layers = 1;
    check(vkCreateFramebuffer(device_.device, &framebuffer, nullptr, &added.framebuffer), doing);
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    check(vkCreateSemaphore(device_.device, &semaphore, nullptr, &added.drawn), doing);
}

} // namespace argand::window
