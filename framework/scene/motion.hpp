// What an object's vertices are made to do.
#pragma once

#include <memory>

#include "framework/config/field.hpp"
#include "framework/scene/selection.hpp"

namespace tack {

class Motion : public Component {
 public:
  static constexpr const char* kind_name = "motion";
  static constexpr const char* kind_doc = "Prescribes the motion of some vertices of an object.";

  void fields(Fields& f) override { f.component("select", select_, "the vertices it holds"); }
  const Selection& selection() const { return *select_; }

 private:
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
};

}  // namespace tack
