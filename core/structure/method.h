#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/assert.h"
#include "core/base/params.h"
#include "core/refs/prim_ref.h"
#include "core/structure/structure.h"

namespace boxwood {

/// Makes references: a plain struct of parameters.
template <class T>
concept ReferenceMaker = std::copyable<T> &&
    requires(T t, const T& c, ParamVisitor& v, const Mesh& mesh, Task& task) {
    t.describe(v);
    { c.make(mesh, task) } -> std::same_as<References>;
};

/// Builds a structure over references: a plain struct of parameters.
template <class T>
concept Builder = std::copyable<T> &&
    requires(T t, const T& c, ParamVisitor& v, const Mesh& mesh, std::span<const PrimRef> refs, Task& task) {
    t.describe(v);
    { c.build(mesh, refs, task) } -> AccelerationStructure;
};

/// Turns one structure into another; the input is shared and never changed.
template <class T>
concept Transform = std::copyable<T> && AccelerationStructure<typename T::Input> &&
    AccelerationStructure<typename T::Output> &&
    requires(T t, const T& c, ParamVisitor& v, const Mesh& mesh, std::span<const PrimRef> refs,
             const typename T::Input& input, Task& task) {
    t.describe(v);
    { c.apply(mesh, refs, input, task) } -> std::same_as<typename T::Output>;
};

/// A transform whose input is built on another frame of an animated scene, by the stages before it: says on
/// which. The mesh and the references that it gets are those of the frame asked for, whose triangles are the
/// same ones in the same order. It takes whole boxes alone: a piece of a triangle is a piece on one frame.
template <class T>
concept TakesInputOfFrame = Transform<T> && requires(const T& c) {
    { c.input_frame() } -> std::same_as<int>;
};

/// A builder that may take so long that a user should know beforehand: seconds of one processor core, about.
template <class T>
concept EstimatesTime = requires(const T& c, size_t triangle_count) {
    { c.estimate_seconds(triangle_count) } -> std::same_as<double>;
};

/// A builder that takes its time: the structure of the builder with the id `kStandIn`, of the same family,
/// may be shown until its own is there.
template <class T>
concept HasStandIn = Builder<T> && requires {
    { T::kStandIn } -> std::convertible_to<const char*>;
};

/// One stage of a recipe with its parameters, of any kind. Of the three functions that run it exactly one
/// applies: the catalog's table says which.
class StageMethod {
public:
    virtual ~StageMethod() = default;
    virtual std::unique_ptr<StageMethod> clone() const = 0;
    virtual void describe(ParamVisitor& visitor) = 0;
    virtual References make(const Mesh& mesh, Task& task) const = 0;
    virtual Structure build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const = 0;
    virtual Structure apply(const Mesh& mesh, std::span<const PrimRef> refs, const Structure& input,
                            Task& task) const = 0;
    /// The frame that a transform's input is built on (see TakesInputOfFrame); nothing: the one asked for.
    virtual std::optional<int> input_frame() const = 0;
    /// See EstimatesTime; 0: not worth a word.
    virtual double estimate_seconds(size_t triangle_count) const = 0;
    /// See HasStandIn; null: none.
    virtual const char* stand_in() const = 0;
};

/// Gives a plain struct of parameters the interface above.
template <class T>
class StageModel final : public StageMethod {
public:
    explicit StageModel(T method = {}) : method_(std::move(method)) {}
    std::unique_ptr<StageMethod> clone() const override { return std::make_unique<StageModel>(method_); }
    void describe(ParamVisitor& visitor) override { method_.describe(visitor); }
    References make(const Mesh& mesh, Task& task) const override {
        if constexpr (ReferenceMaker<T>) return method_.make(mesh, task);
        return not_this_kind<References>();
    }
    Structure build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const override {
        if constexpr (Builder<T>) return Structure(method_.build(mesh, refs, task));
        return not_this_kind<Structure>();
    }
    Structure apply(const Mesh& mesh, std::span<const PrimRef> refs, const Structure& input,
                    Task& task) const override {
        if constexpr (Transform<T>) {
            const auto* concrete = input.as<typename T::Input>();
            BOXWOOD_ASSERT(concrete != nullptr);
            return Structure(method_.apply(mesh, refs, *concrete, task));
        }
        return not_this_kind<Structure>();
    }
    double estimate_seconds([[maybe_unused]] size_t triangle_count) const override {
        if constexpr (EstimatesTime<T>) return method_.estimate_seconds(triangle_count);
        return 0.0;
    }
    const char* stand_in() const override {
        if constexpr (HasStandIn<T>) return T::kStandIn;
        return nullptr;
    }
    std::optional<int> input_frame() const override {
        if constexpr (TakesInputOfFrame<T>) return method_.input_frame();
        return std::nullopt;
    }

private:
    template <class Result>
    [[noreturn]] static Result not_this_kind() {
        assertion_failed("a stage is run as the kind of its catalog table", __FILE__, __LINE__);
    }
    T method_;
};

}  // namespace boxwood
