// results.h5: the table of a batch as HDF5, for tables of many cases. Layout:
// - a dataset of the file per column, with a value per case: numbers are 64-bit floats (NaN: no
//   such number), texts are UTF-8 of variable length. A column is one of numbers if each of its
//   cells is a number or empty, as of a parameter in Pa
// - attributes of a dataset: name (of the column; the dataset has "_" for "/"), role
//   (ColumnRole), unit ("Pa"; "1" without one)
// - attributes of the file: format ("tack batch"), name, about, file, provenance (JSON), columns
//   (their datasets, in order)
// Datasets of numbers are compressed in chunks; a program reads single columns without the rest.
#pragma once

#include <filesystem>

#include "framework/batch/results_table.hpp"

namespace tack {

// Writes the table; replaces the file as a whole. Throws InputError if it cannot be written.
void write_results_hdf5(const std::filesystem::path& path, const ResultsTable& table,
                        const BatchDescription& description);

}  // namespace tack
