#include "device/vulkan/raster_image.hpp"

#include "base/error.hpp"
#include "device/vulkan/result.hpp"

#include <array>

namespace argand::vulkan {

namespace {

constexpr const char* memory_name = "raster image";

VkImage make_image(VkDevice device, const RasterImageSize& size, VkFormat format,
                   VkImageUsageFlags usage) {
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = format;
    create.extent = {size.width, size.height, 1};
    create.mipLevels = 1;
    create.arrayLayers = size.layers;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = usage;
    VkImage image = VK_NULL_HANDLE;
    check(vkCreateImage(device, &create, nullptr, &image), "creating a raster image");
    return image;
}

VkImageView make_view(VkDevice device, VkImage image, const RasterImageSize& size, VkFormat format,
                      VkImageAspectFlags aspect) {
    VkImageViewCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    create.image = image;
    create.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    create.format = format;
    create.subresourceRange = {aspect, 0, 1, 0, size.layers};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device, &create, nullptr, &view), "creating a view of a raster image");
    return view;
}

} // namespace

VkFormat color_format(std::uint32_t words) {
    return words == 1   ? VK_FORMAT_R32_UINT
           : words == 2 ? VK_FORMAT_R32G32_UINT
                        : VK_FORMAT_R32G32B32A32_UINT;
}

VkRenderPass make_render_pass(VkDevice device, std::uint32_t words) {
    std::array<VkAttachmentDescription, 2> attachments{};
    for (VkAttachmentDescription& attachment : attachments) {
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    attachments[0].format = color_format(words);
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    attachments[1].format = depth_format;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    // Before, the last draw and the copy of its result are over; after, the result is copied.
    constexpr VkPipelineStageFlags attached = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                              VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                              VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkAccessFlags written =
        VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    const std::array<VkSubpassDependency, 2> dependencies{
        {{VK_SUBPASS_EXTERNAL, 0, attached | VK_PIPELINE_STAGE_TRANSFER_BIT, attached, written,
          written | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0},
         {0, VK_SUBPASS_EXTERNAL, attached, VK_PIPELINE_STAGE_TRANSFER_BIT, written,
          VK_ACCESS_TRANSFER_READ_BIT, 0}}};
    VkRenderPassCreateInfo create{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    create.attachmentCount = attachments.size();
    create.pAttachments = attachments.data();
    create.subpassCount = 1;
    create.pSubpasses = &subpass;
    create.dependencyCount = dependencies.size();
    create.pDependencies = dependencies.data();
    VkRenderPass pass = VK_NULL_HANDLE;
    check(vkCreateRenderPass(device, &create, nullptr, &pass), "creating a render pass");
    return pass;
}

RasterImage::~RasterImage() {
    vkDestroyFramebuffer(device->handle, framebuffer, nullptr);
    for (const VkImageView view : {color_view, depth_view}) {
        vkDestroyImageView(device->handle, view, nullptr);
    }
    for (const VkImage image : {color, depth}) {
        vkDestroyImage(device->handle, image, nullptr);
    }
    vkFreeMemory(device->handle, memory, nullptr);
    const std::shared_ptr<DeviceMemory> entered = ledger.lock();
    if (entered && memory) {
        entered->ledger().freed(memory_name, bytes);
    }
}

std::shared_ptr<RasterImage> make_raster_image(VkPhysicalDevice physical,
                                               const std::shared_ptr<LogicalDevice>& device,
                                               const std::shared_ptr<DeviceMemory>& ledger,
                                               const DeviceInfo& info, VkRenderPass pass,
                                               const RasterImageSize& size) {
    auto image = std::make_shared<RasterImage>();
    image->size = size;
    image->device = device;
    image->color =
        make_image(device->handle, size, color_format(size.words),
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    image->depth =
        make_image(device->handle, size, depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    std::array<VkMemoryRequirements, 2> needs;
    vkGetImageMemoryRequirements(device->handle, image->color, needs.data());
    vkGetImageMemoryRequirements(device->handle, image->depth, &needs[1]);
    const VkDeviceSize depth_at =
        (needs[0].size + needs[1].alignment - 1) / needs[1].alignment * needs[1].alignment;
    image->bytes = depth_at + needs[1].size;
    check_memory(info, ledger->ledger(), memory_name, image->bytes);
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = image->bytes;
    allocate.memoryTypeIndex =
        memory_type(physical, needs[0].memoryTypeBits & needs[1].memoryTypeBits, 0,
                    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (allocate.memoryTypeIndex == UINT32_MAX ||
        vkAllocateMemory(device->handle, &allocate, nullptr, &image->memory) != VK_SUCCESS) {
        return nullptr;
    }
    ledger->ledger().allocated(memory_name, image->bytes);
    image->ledger = ledger;
    check(vkBindImageMemory(device->handle, image->color, image->memory, 0), "binding memory");
    check(vkBindImageMemory(device->handle, image->depth, image->memory, depth_at),
          "binding memory");
    image->color_view = make_view(device->handle, image->color, size, color_format(size.words),
                                  VK_IMAGE_ASPECT_COLOR_BIT);
    image->depth_view =
        make_view(device->handle, image->depth, size, depth_format, VK_IMAGE_ASPECT_DEPTH_BIT);
    const std::array<VkImageView, 2> views{image->color_view, image->depth_view};
    VkFramebufferCreateInfo framebuffer{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    framebuffer.renderPass = pass;
    framebuffer.attachmentCount = views.size();
    framebuffer.pAttachments = views.data();
    framebuffer.width = size.width;
    framebuffer.height = size.height;
    framebuffer.layers = size.layers;
    check(vkCreateFramebuffer(device->handle, &framebuffer, nullptr, &image->framebuffer),
          "creating a framebuffer");
    return image;
}

} // namespace argand::vulkan
