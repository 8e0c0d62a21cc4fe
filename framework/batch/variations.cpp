// Variations of keys: grids, lists and samples.
#include <fmt/format.h>

#include <numeric>
#include <random>

#include "framework/batch/sobol.hpp"
#include "framework/batch/varied_keys.hpp"
#include "framework/batch/variation.hpp"
#include "geometry/errors.hpp"

namespace tack {

Variant joined(const Variant& a, const Variant& b) {
  Variant both = a;
  both.set.insert(both.set.end(), b.set.begin(), b.set.end());
  both.shown.insert(both.shown.end(), b.shown.begin(), b.shown.end());
  return both;
}

namespace {

Variant variant_of(const VariedKey& key, const Value& value) {
  return {{{key.key, value}}, {{key.column, shown_text(value), key.key}}};
}

class GridVariation : public Variation {
 public:
  void fields(Fields& f) override { f.raw("keys", keys_, "scene keys, each with a list of values").required(); }
  std::vector<Variant> variants() const override {
    std::vector<Variant> all{{}};
    for (const VariedKey& key : keys_with_values(keys_)) {
      std::vector<Variant> next;
      for (const Variant& one : all)
        for (const Value& value : key.values) next.push_back(joined(one, variant_of(key, value)));
      all = std::move(next);
    }
    return all;
  }
  double count() const override {
    double all = 1;
    for (const VariedKey& key : keys_with_values(keys_)) all *= static_cast<double>(key.values.size());
    return all;
  }

 private:
  Value keys_;
};

class ZipVariation : public Variation {
 public:
  void fields(Fields& f) override {
    f.raw("keys", keys_, "scene keys, each with a list of values; all lists have equal lengths").required();
  }
  std::vector<Variant> variants() const override {
    const std::vector<VariedKey> keys = keys_with_values(keys_);
    std::vector<Variant> all(keys.front().values.size());
    for (const VariedKey& key : keys) {
      if (key.values.size() != all.size())
        throw InputError(fmt::format("{}: {} has {} values, {} has {}; type: zip takes the first of each, then the second, ...",
                                     key.mark.text(), key.key, key.values.size(), keys.front().key, all.size()));
      for (size_t i = 0; i < all.size(); ++i) all[i] = joined(all[i], variant_of(key, key.values[i]));
    }
    return all;
  }

 private:
  Value keys_;
};

struct NamedSettings {
  std::string name;
  Value set;
  void fields(Fields& f) {
    f.text("name", name, "name in tables").required().line();
    f.raw("set", set, "scene keys with their values");
  }
};

class CasesVariation : public Variation {
 public:
  void fields(Fields& f) override {
    f.list("cases", cases_, "cases, in order").required().nonempty();
    f.text("as", column_, "heading of the names in tables").line();
  }
  std::vector<Variant> variants() const override {
    std::vector<Variant> all;
    for (const NamedSettings& one : cases_) {
      if (!one.set.is_map() && !one.set.is_null())
        throw InputError(fmt::format("{}: set: expects a map of keys to values, got {}", one.set.mark.text(), one.set.description()));
      Variant variant{{}, {{column_, one.name, ""}}};
      for (const Value::Entry& e : one.set.entries) variant.set.push_back({e.key, e.value});
      all.push_back(std::move(variant));
    }
    return all;
  }

 private:
  std::vector<NamedSettings> cases_;
  std::string column_ = "variant";
};

// Sampled ranges: points of the unit cube with a coordinate per key.
class SampledVariation : public Variation {
 public:
  void fields(Fields& f) override {
    f.raw("keys", keys_, "scene keys, each with a range: {from: 1 kPa, to: 1 MPa, scale: log}").required();
    f.integer("samples", samples_, "number of samples").required().at_least(1);
  }
  std::vector<Variant> variants() const final {
    const std::vector<VariedKey> keys = keys_with_ranges(keys_);
    const std::vector<double> points = unit_points(static_cast<int>(keys.size()));
    std::vector<Variant> all(samples_);
    for (int i = 0; i < samples_; ++i)
      for (size_t k = 0; k < keys.size(); ++k)
        all[i] = joined(all[i], variant_of(keys[k], keys[k].range->at(points[i * keys.size() + k])));
    return all;
  }
  double count() const final { return samples_; }

 protected:
  // Returns samples x dimensions coordinates in [0, 1), row by row.
  virtual std::vector<double> unit_points(int dimensions) const = 0;

  int samples_ = 1;

 private:
  Value keys_;
};

class LatinHypercubeVariation : public SampledVariation {
 public:
  void fields(Fields& f) override {
    SampledVariation::fields(f);
    f.integer("seed", seed_, "random seed");
  }

 protected:
  std::vector<double> unit_points(int dimensions) const override {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed_));
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<double> points(static_cast<size_t>(samples_) * dimensions);
    std::vector<int> strata(samples_);
    for (int k = 0; k < dimensions; ++k) {
      std::iota(strata.begin(), strata.end(), 0);
      for (int i = samples_ - 1; i > 0; --i) std::swap(strata[i], strata[static_cast<int>(unit() * (i + 1))]);
      for (int i = 0; i < samples_; ++i) points[i * dimensions + k] = (strata[i] + unit()) / samples_;
    }
    return points;
  }

 private:
  int seed_ = 1;
};

class SobolVariation : public SampledVariation {
 protected:
  std::vector<double> unit_points(int dimensions) const override {
    // Includes the origin as first point, so that powers of two points are balanced.
    std::vector<double> points(static_cast<size_t>(dimensions), 0.0);
    const std::vector<double> others = sobol_points(samples_ - 1, dimensions);
    points.insert(points.end(), others.begin(), others.end());
    return points;
  }
};

class RepeatVariation : public Variation {
 public:
  void fields(Fields& f) override {
    f.integer("count", count_, "number of repeats").required().at_least(1);
    f.texts("keys", keys_, "scene keys of seeds that take the numbers of the repeats; without any, all repeats are equal");
    f.integer("first", first_, "number of the first one");
    f.text("as", column_, "heading of the numbers in tables").line();
  }
  std::vector<Variant> variants() const override {
    std::vector<Variant> all;
    for (long i = first_; i < static_cast<long>(first_) + count_; ++i) {
      Variant variant{{}, {{column_, fmt::format("{}", i), ""}}};
      for (const std::string& key : keys_) {
        Value value = Value::scalar(fmt::format("{}", i));
        value.mark.file = std::make_shared<const std::string>(fmt::format("repeat {}", key));
        variant.set.push_back({key, std::move(value)});
      }
      all.push_back(std::move(variant));
    }
    return all;
  }
  double count() const override { return count_; }

 private:
  int count_ = 1, first_ = 1;
  std::vector<std::string> keys_;
  std::string column_ = "repeat";
};

TACK_REGISTER(Variation, GridVariation, "grid", "All combinations of the values of several keys, the last key varying fastest.", "");
TACK_REGISTER(Variation, ZipVariation, "zip", "The first value of each key, then the second of each, and so on.", "");
TACK_REGISTER(Variation, CasesVariation, "cases", "A list of named sets of keys.", "");
TACK_REGISTER(Variation, LatinHypercubeVariation, "latin_hypercube",
              "Latin hypercube: random samples, one in each of as many equal intervals of every range.", "McKay, Beckman and Conover 1979");
TACK_REGISTER(Variation, SobolVariation, "sobol",
              "Sobol sequence: samples that fill the ranges evenly; more samples extend the existing ones. Powers of two are best.",
              "Sobol 1967; Joe and Kuo 2008");
TACK_REGISTER(Variation, RepeatVariation, "repeat", "Repeats with different seeds.", "");

}  // namespace
}  // namespace tack
