// print_layout: sizes, alignments and offsets as this compiler has them, one number to a line, with the type behind it.
#include <cstdio>
#include <string>

#include "tests/cuda/layout/walk_layout.h"

namespace {

struct Printer {
    template <class T>
    static std::string name() {
        std::string text = __PRETTY_FUNCTION__;
        text = text.substr(text.find("T = ") + 4);
        return text.substr(0, text.find_first_of(";]"));
    }
    template <class T>
    void type(std::size_t size, std::size_t alignment) const {
        std::printf("%zu\tsize of %s\n%zu\talignment\n", size, name<T>().c_str(), alignment);
    }
    template <class M>
    void member(std::uint32_t offset) const {
        std::printf("%u\toffset of a member %s\n", offset, name<M>().c_str());
    }
};

}  // namespace

int main() {
    Printer printer;
    pl::layout::walk_kernels(printer);
    return 0;
}
