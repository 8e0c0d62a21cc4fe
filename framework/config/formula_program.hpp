// A formula as a list of operations on a stack, for number types of its own: packs of numbers,
// numbers with derivatives. Its grammar is a part of that of Formula (formula.hpp): + - * / ^,
// parentheses, numbers, pi, named variables and constants, and the functions exp, ln, log (as ln),
// sqrt, abs, sin, cos, tanh, min and max of two.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "geometry/errors.hpp"

namespace tack {

class FormulaProgram {
 public:
  /// Throws InputError, without a source location, for what Formula refuses and for operations that
  /// are not among those above.
  FormulaProgram(const std::string& text, const std::vector<std::string>& variables,
                 const std::map<std::string, double>& constants);

  bool uses(int variable) const;
  bool uses(const std::string& constant) const { return constants_.contains(constant); }

  /// Returns the value. variables: in the order of their names. T has +, -, *, /, and by
  /// argument-dependent lookup exp, log, sqrt, abs, sin, cos, tanh, min, max and
  /// power(T, double).
  template <class T>
  T operator()(const T* variables) const {
    T stack[depth_max];
    int top = -1;
    for (const Operation& o : operations_) {
      switch (o.code) {
        case Code::number: stack[++top] = T(o.number); break;
        case Code::variable: stack[++top] = variables[o.variable]; break;
        case Code::negate: stack[top] = T(0.0) - stack[top]; break;
        case Code::power: stack[top] = power(stack[top], o.number); break;
        case Code::exp: stack[top] = exp(stack[top]); break;
        case Code::log: stack[top] = log(stack[top]); break;
        case Code::sqrt: stack[top] = sqrt(stack[top]); break;
        case Code::abs: stack[top] = abs(stack[top]); break;
        case Code::sin: stack[top] = sin(stack[top]); break;
        case Code::cos: stack[top] = cos(stack[top]); break;
        case Code::tanh: stack[top] = tanh(stack[top]); break;
        default: {
          const T b = stack[top--], a = stack[top];
          stack[top] = of_two(o.code, a, b);
        }
      }
    }
    return stack[0];
  }

 private:
  enum class Code {
    number,
    variable,
    negate,
    power,
    exp,
    log,
    sqrt,
    abs,
    sin,
    cos,
    tanh,
    add,
    subtract,
    multiply,
    divide,
    general_power,
    min,
    max
  };
  struct Operation {
    Code code;
    int variable = -1;
    double number = 0;  // also the exponent of a power
  };
  class Parser;
  static constexpr int depth_max = 24;

  template <class T>
  static T of_two(Code code, const T& a, const T& b) {
    switch (code) {
      case Code::add: return a + b;
      case Code::subtract: return a - b;
      case Code::multiply: return a * b;
      case Code::divide: return a / b;
      case Code::min: return min(a, b);
      case Code::max: return max(a, b);
      default: return exp(b * log(a));
    }
  }

  std::vector<Operation> operations_;
  std::set<std::string> constants_;  // that the formula has
};

}  // namespace tack
