#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>

#include <limits>

#include "core/strips.h"
#include "tests/bench/peers/adapters.h"

namespace pstrips::bench {

Strips vtk_strips(const StripInput& input, const StripOptions&) {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(input.wedge_count);
  for (Index w = 0; w < input.wedge_count; ++w) points->SetPoint(w, 0, 0, 0);
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < input.triangles.size(); i += 3) {
    const vtkIdType corners[] = {input.triangles[i], input.triangles[i + 1],
                                 input.triangles[i + 2]};
    triangles->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(mesh);
  stripper->SetMaximumLength(std::numeric_limits<int>::max() / 2);
  stripper->Update();

  Strips strips;
  const auto append = [&](vtkCellArray* cells) {
    vtkIdType count = 0;
    const vtkIdType* wedges = nullptr;
    for (cells->InitTraversal(); cells->GetNextCell(count, wedges);) {
      if (!strips.empty()) strips.push_back(kRestart);
      for (vtkIdType i = 0; i < count; ++i) strips.push_back(static_cast<Index>(wedges[i]));
    }
  };
  append(stripper->GetOutput()->GetStrips());
  append(stripper->GetOutput()->GetPolys());
  return strips;
}

}  // namespace pstrips::bench
