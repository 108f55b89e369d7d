#include "base/error.hpp"
#include "device/device.hpp"

namespace argand {

StageScope::~StageScope() {
    try {
        device_.end_stage();
    } catch (const Error&) { // NOLINT(bugprone-empty-catch): see the declaration
    }
}

} // namespace argand
