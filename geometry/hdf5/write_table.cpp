#include <hdf5.h>

#include <algorithm>

#include "geometry/hdf5/functions.hpp"

namespace tack {
namespace {

// Sizes of compression; usual for columns that are read as a whole.
constexpr hsize_t chunk_rows = 16384;
constexpr unsigned deflate_level = 4;

// Thrown when a call of the library fails.
struct Failed {};

void check(herr_t status) {
  if (status < 0) throw Failed{};
}

// An identifier of the library, closed in the end.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {
    if (id_ < 0) throw Failed{};
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

// Keeps HDF5 from printing its errors.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// UTF-8 of variable length.
class TextType : public Handle {
 public:
  TextType() : Handle(H5Tcopy(H5T_C_S1), H5Tclose) {
    check(H5Tset_size(*this, H5T_VARIABLE));
    check(H5Tset_cset(*this, H5T_CSET_UTF8));
  }
};

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
  std::vector<const char*> all;
  all.reserve(texts.size());
  for (const std::string& text : texts) all.push_back(text.c_str());
  return all;
}

// list: as an array, also of one text.
void write_attribute(hid_t to, const std::string& name, const std::vector<std::string>& texts, bool list) {
  const TextType type;
  const hsize_t count = texts.size();
  const Handle space(list ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(to, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, type, pointers(texts).data()));
}

void write_column(hid_t file, const Hdf5Column& column) {
  const bool numbers = column.numbers != nullptr;
  const TextType text;
  const hsize_t rows = numbers ? column.numbers->size() : column.texts->size();
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose), layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (numbers && rows > 0) {
    const hsize_t chunk = std::min(chunk_rows, rows);
    check(H5Pset_chunk(layout, 1, &chunk));
    check(H5Pset_shuffle(layout));
    check(H5Pset_deflate(layout, deflate_level));
  }
  const Handle dataset(H5Dcreate2(file, column.name.c_str(), numbers ? H5T_IEEE_F64LE : static_cast<hid_t>(text), space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
  if (rows > 0 && numbers) check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.numbers->data()));
  if (rows > 0 && !numbers) check(H5Dwrite(dataset, text, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers(*column.texts).data()));
  for (const auto& [name, value] : column.attributes) write_attribute(dataset, name, {value}, false);
}

}  // namespace

bool write_table_by_hdf5(const std::string& path, const Hdf5Attributes& attributes, const std::vector<Hdf5Column>& columns) {
  try {
    const Silence silence;
    const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    for (const auto& [name, value] : attributes) write_attribute(file, name, {value}, false);
    std::vector<std::string> names;
    for (const Hdf5Column& column : columns) {
      write_column(file, column);
      names.push_back(column.name);
    }
    write_attribute(file, "columns", names, true);
    check(H5Fflush(file, H5F_SCOPE_LOCAL));
    return true;
  } catch (const Failed&) {
    return false;
  }
}

}  // namespace tack
