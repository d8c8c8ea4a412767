#include "ui/worker/picture_size.h"

namespace pl::ui {

void PictureSize::resize(int width, int height) {
    width_ = width;
    height_ = height;
    divider_ = 0;
}

bool PictureSize::apply(Session& session, bool is_coarse) {
    const int divider = is_coarse ? motion_.divider_for(width_, height_) : 1;
    if (divider == divider_) return false;
    divider_ = divider;
    const EditSize size{divided(width_, divider), divided(height_, divider)};
    if (session.settings().width == size.width && session.settings().height == size.height) return false;
    session.apply(size);
    return true;
}

}  // namespace pl::ui
