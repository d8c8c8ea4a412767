#include "ui/draw/method_keys.h"

namespace pl::ui {

std::string method_keys(bool MethodInfo::*flag) {
    std::string keys;
    for (const MethodInfo& method : all_methods())
        if (flag == nullptr || method.*flag) keys += (keys.empty() ? "" : ", ") + std::string(1, method.key);
    return keys;
}

}  // namespace pl::ui
