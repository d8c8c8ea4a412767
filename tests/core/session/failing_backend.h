// A back end that works until a test makes it fail, like a lost device.
#pragma once

#include "core/base/error.h"
#include "tests/core/session/forwarding_backend.h"

namespace pl::test {

/// The CPU back end, until one of its functions is made to fail.
class FailingBackend final : public ForwardingBackend {
public:
    enum class Failure { None, Scene, Volumes, Tables, Download, Pass };

    Failure failure = Failure::None;

    void upload_scene(std::shared_ptr<const HostScene> scene) override {
        check(Failure::Scene);
        ForwardingBackend::upload_scene(std::move(scene));
    }
    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        check(Failure::Volumes);
        ForwardingBackend::upload_volumes(std::move(volumes), shape);
    }
    void upload_field(MethodId method, HostField tables) override {
        check(Failure::Tables);
        ForwardingBackend::upload_field(method, std::move(tables));
    }
    HostField download_field(MethodId method) const override {
        check(Failure::Download);
        return ForwardingBackend::download_field(method);
    }
    PassCounters run_pass(const PassRequest& request) override {
        check(Failure::Pass);
        return ForwardingBackend::run_pass(request);
    }

private:
    void check(Failure asked) const {
        if (failure == asked) throw Error(ErrorKind::Unavailable, "the device is gone");
    }
};

}  // namespace pl::test
