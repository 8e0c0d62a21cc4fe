// Function table of the shared library libtack_hdf5.so: tables as HDF5 files. The program opens it
// for the first such file (framework/batch/hdf5_library.hpp). A library of its own, loaded without
// making its symbols global: packages of Python bring other versions of HDF5 into one process.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tack {

// Attributes: names and texts.
using Hdf5Attributes = std::vector<std::pair<std::string, std::string>>;

// A column of a table: a dataset of the file.
struct Hdf5Column {
  std::string name;  // of the dataset; without "/"
  Hdf5Attributes attributes;
  // One of both, with a value per row: 64-bit floats, compressed in chunks, or UTF-8.
  const std::vector<double>* numbers = nullptr;
  const std::vector<std::string>* texts = nullptr;
};

// Writes a file with these attributes, and an attribute `columns` with the names of the datasets in
// order. Returns false if the file is not complete.
bool write_table_by_hdf5(const std::string& path, const Hdf5Attributes& attributes,
                         const std::vector<Hdf5Column>& columns);

struct Hdf5Functions {
  // TACK_HDF5_INTERFACE: a digest of these headers and of how they were compiled.
  const char* interface;
  decltype(&write_table_by_hdf5) write_table;
};

}  // namespace tack
