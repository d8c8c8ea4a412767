// The program: for now it only tells its version.
#include <cstdio>

int main() {
    std::puts("pathlight " PL_VERSION);
    return 0;
}
