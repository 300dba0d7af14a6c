#include "isolux/viz/viewer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkCollection.h>
#include <vtkInteractorStyleTerrain.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "isolux/base/error.h"
#include "isolux/io/safe_file.h"
#include "isolux/viz/display.h"
#include "isolux/viz/probe.h"
#include "isolux/viz/viewer_parts.h"
#include "isolux/viz/web_export.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace isolux {

namespace {

/// Turns the eye about the upright axis; VTK's own keys stay without effect.
class ViewerStyle : public vtkInteractorStyleTerrain {
public:
    static ViewerStyle* New();

    vtkTypeMacro(ViewerStyle, vtkInteractorStyleTerrain)

        void OnChar() override {}
};

vtkStandardNewMacro(ViewerStyle)

    void show(const Props& props, bool is_visible) {
    for (vtkProp* p : props)
        p->SetVisibility(is_visible ? 1 : 0);
}

/// What is switched on, and the window it is switched on in.
class Viewer {
public:
    Viewer(const ResultsDocument& document,
           const std::filesystem::path& folder,
           const ViewerOptions& options)
        : results_(document.results), options_(options), only_(options.surface) {
        renderer_->SetBackground(1.0, 1.0, 1.0);
        window_->SetSize(options.width, options.height);
        window_->SetMultiSamples(8);
        window_->AddRenderer(renderer_);
        window_->SetWindowName(("isolux: " + document.project_name).c_str());
        room_ = add_room(*renderer_, folder / "room.vtp");
        renderer_->ComputeVisiblePropBounds(bounds_.data());
        luminaires_ = add_luminaires(*renderer_, document.plan);
        webs_ = add_webs(*renderer_,
                         folder / (std::string(webs_stem) + ".vtp"),
                         document.plan,
                         0.35 * (bounds_[5] - bounds_[4]));
        const MapScale scale = make_common_scale(results_);
        for (const SurfaceResult& s : results_.surfaces)
            surfaces_.push_back(add_surface(*renderer_, s, scale, surfaces_.size()));
        legend_ = add_legend(*renderer_, scale);
        add_text(heading_, 0.012, 0.985, 17);
        heading_->GetTextProperty()->SetVerticalJustificationToTop();
        add_text(message_, 0.012, 0.015, 15);
        title_ = document.project_name;
        add_marker();
        vtkNew<vtkCallbackCommand> before;
        before->SetClientData(this);
        before->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
            static_cast<Viewer*>(self)->update_lines();
        });
        renderer_->AddObserver(vtkCommand::StartEvent, before);
        look(options.camera);
        show_surfaces();
        say("h: keys");
        if (options.probe)
            probe(*options.probe);
    }

    void open() {
        vtkNew<vtkRenderWindowInteractor> interactor;
        vtkNew<ViewerStyle> style;
        interactor->SetRenderWindow(window_);
        interactor->SetInteractorStyle(style);
        vtkNew<vtkCallbackCommand> call;
        call->SetClientData(this);
        call->SetCallback([](vtkObject* from, unsigned long event, void* self, void*) {
            static_cast<Viewer*>(self)->react(*vtkRenderWindowInteractor::SafeDownCast(from),
                                              event);
        });
        for (const auto event : {vtkCommand::KeyPressEvent,
                                 vtkCommand::LeftButtonPressEvent,
                                 vtkCommand::LeftButtonReleaseEvent})
            interactor->AddObserver(event, call, 1.0F);
        window_->Render();
        interactor->Start();
    }

    void save(const std::filesystem::path& file) {
        window_->Render();
        vtkNew<vtkWindowToImageFilter> picture;
        picture->SetInput(window_);
        picture->ReadFrontBufferOff();
        vtkNew<vtkPNGWriter> writer;
        writer->SetInputConnection(picture->GetOutputPort());
        writer->WriteToMemoryOn();
        writer->Write();
        vtkUnsignedCharArray* bytes = writer->GetResult();
        write_file_safely(file,
                          {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                           static_cast<std::size_t>(bytes->GetNumberOfValues())});
    }

    void draw_off_screen() { window_->SetOffScreenRendering(1); }

private:
    void add_text(vtkTextActor* text, double x, double y, int size) {
        text->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
        text->GetTextProperty()->SetBackgroundColor(1.0, 1.0, 1.0);
        text->GetTextProperty()->SetBackgroundOpacity(0.8);
        text->GetTextProperty()->SetFontSize(size);
        text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
        text->SetPosition(x, y);
        renderer_->AddActor2D(text);
    }

    void add_marker() {
        vtkNew<vtkSphereSource> ball;
        ball->SetRadius(0.012 * std::hypot(bounds_[1] - bounds_[0], bounds_[3] - bounds_[2]));
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputConnection(ball->GetOutputPort());
        marker_->SetMapper(mapper);
        marker_->GetProperty()->SetColor(0.9, 0.0, 0.5);
        marker_->VisibilityOff();
        marker_->PickableOff();
        renderer_->AddActor(marker_);
    }

    void say(const std::string& words) { message_->SetInput(words.c_str()); }

    /// Whether the front of a surface with lines is seen; its colours are culled otherwise.
    [[nodiscard]] bool is_front_seen(const GridLayout& grid) const {
        vtkCamera* eye = renderer_->GetActiveCamera();
        const double* at = eye->GetPosition();
        const double* along = eye->GetDirectionOfProjection();
        const Vector3 to_eye = eye->GetParallelProjection() != 0
                                   ? Vector3{-along[0], -along[1], -along[2]}
                                   : Point3{at[0], at[1], at[2]} - grid.frame.origin;
        return dot(Vector3(grid.frame.z), to_eye) > 0.0;
    }

    /// Before every picture: isolux lines follow the colours they belong to.
    void update_lines() {
        for (std::size_t s = 0; s < surfaces_.size(); ++s)
            if (surfaces_[s].lines != nullptr)
                surfaces_[s].lines->SetVisibility(
                    has_lines_ && surfaces_[s].colours->GetVisibility() != 0
                            && is_front_seen(*results_.surfaces[s].surface.grid)
                        ? 1
                        : 0);
    }

    void show_surfaces() {
        for (std::size_t s = 0; s < surfaces_.size(); ++s) {
            const bool is_on = !only_ || *only_ == s;
            surfaces_[s].colours->SetVisibility(is_on ? 1 : 0);
        }
        const std::string which =
            only_ ? results_.surfaces[*only_].surface.name : "all calculation surfaces";
        heading_->SetInput((title_ + "\n" + which).c_str());
    }

    /// Keeps what lies behind a plane, of everything in space.
    void cut(const std::array<double, 3>& origin, const std::array<double, 3>& normal) {
        vtkNew<vtkPlane> plane;
        plane->SetOrigin(origin.data());
        plane->SetNormal(normal.data());
        vtkActorCollection* actors = renderer_->GetActors();
        actors->InitTraversal();
        while (vtkActor* actor = actors->GetNextActor()) {
            actor->GetMapper()->RemoveAllClippingPlanes();
            if (normal != std::array<double, 3>{})
                actor->GetMapper()->AddClippingPlane(plane);
        }
    }

    void look(ViewerCamera camera) {
        const std::array<double, 3> middle{0.5 * (bounds_[0] + bounds_[1]),
                                           0.5 * (bounds_[2] + bounds_[3]),
                                           0.5 * (bounds_[4] + bounds_[5])};
        vtkCamera* eye = renderer_->GetActiveCamera();
        eye->SetParallelProjection(camera == ViewerCamera::orbit ? 0 : 1);
        eye->SetFocalPoint(middle.data());
        eye->SetViewUp(0.0, 0.0, 1.0);
        switch (camera) {
        case ViewerCamera::orbit:
            eye->SetPosition(middle[0] - 1.0, middle[1] - 1.6, middle[2] + 1.3);
            cut({}, {});
            break;
        case ViewerCamera::plan: {
            constexpr double off = 0.01; // m below the ceiling
            eye->SetPosition(middle[0], middle[1], middle[2] + 1.0);
            eye->SetViewUp(0.0, 1.0, 0.0);
            cut({middle[0], middle[1], bounds_[5] - off}, {0.0, 0.0, -1.0});
            break;
        }
        case ViewerCamera::section:
            eye->SetPosition(middle[0], middle[1] - 1.0, middle[2]);
            cut(middle, {0.0, 1.0, 0.0});
            break;
        }
        renderer_->ResetCamera(bounds_.data());
        eye->Zoom(camera == ViewerCamera::orbit ? 1.05 : 1.4);
        renderer_->ResetCameraClippingRange();
    }

    void probe(const Point3& place) {
        const auto found = find_nearest_point(results_, place, only_);
        if (!found)
            return;
        say(describe_point(results_, *found));
        const Point3& p =
            results_.surfaces[found->surface].surface.receivers[found->point].point;
        marker_->SetPosition(p.x, p.y, p.z);
        marker_->VisibilityOn();
    }

    void react(vtkRenderWindowInteractor& interactor, unsigned long event) {
        const int* at = interactor.GetEventPosition();
        if (event == vtkCommand::LeftButtonPressEvent) {
            pressed_ = {at[0], at[1]};
            return;
        }
        if (event == vtkCommand::LeftButtonReleaseEvent) {
            constexpr int still = 3; // pixels: a click, no turn
            vtkNew<vtkCellPicker> picker;
            if (std::abs(at[0] - pressed_[0]) > still || std::abs(at[1] - pressed_[1]) > still
                || picker->Pick(at[0], at[1], 0.0, renderer_) == 0)
                return;
            const double* x = picker->GetPickPosition();
            probe({x[0], x[1], x[2]});
        } else {
            const std::string key = interactor.GetKeySym() ? interactor.GetKeySym() : "";
            if (key == "q" || key == "Escape") {
                interactor.TerminateApp();
                return;
            }
            press(key);
        }
        renderer_->ResetCameraClippingRange();
        window_->Render();
    }

    void press(const std::string& key) {
        if (key == "1")
            look(ViewerCamera::orbit);
        else if (key == "2")
            look(ViewerCamera::plan);
        else if (key == "3")
            look(ViewerCamera::section);
        else if (key == "r")
            show(room_, has_room_ = !has_room_);
        else if (key == "l")
            show(luminaires_, has_luminaires_ = !has_luminaires_);
        else if (key == "w")
            show(webs_, has_webs_ = !has_webs_);
        else if (key == "i") {
            has_lines_ = !has_lines_;
        } else if (key == "n") {
            const std::size_t next = only_ ? *only_ + 1 : 0;
            only_ = next < surfaces_.size() ? std::optional(next) : std::nullopt;
            show_surfaces();
        } else if (key == "s") {
            save("isolux-view.png");
            say("saved as isolux-view.png");
        } else if (key == "h")
            say(viewer_keys());
    }

    const Results& results_;
    const ViewerOptions& options_;
    std::optional<std::size_t> only_;
    std::string title_;
    std::array<double, 6> bounds_{};
    std::array<int, 2> pressed_{};
    bool has_room_ = true, has_luminaires_ = true, has_webs_ = true, has_lines_ = true;
    Props room_, luminaires_, webs_, legend_;
    std::vector<SurfaceProps> surfaces_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkRenderWindow> window_;
    vtkNew<vtkTextActor> heading_;
    vtkNew<vtkTextActor> message_;
    vtkNew<vtkActor> marker_;
};

} // namespace

std::string viewer_keys() {
    return "1 orbit, 2 plan, 3 section\n"
           "n next calculation surface, i isolux lines\n"
           "l luminaires, w photometric webs, r room\n"
           "click: values of the nearest point\n"
           "s save isolux-view.png, h these keys, q quit";
}

void view_results(const ResultsDocument& document,
                  const std::filesystem::path& folder,
                  const ViewerOptions& options) {
    if (const auto problem = find_display_problem())
        throw InputError("isolux view",
                         "no window can be opened (" + *problem + ")",
                         "`xvfb-run isolux view ... --screenshot FILE.png` needs no screen, "
                         "`--probe x,y,z` alone no window");
    Viewer viewer(document, folder, options);
    if (options.screenshot) {
        viewer.draw_off_screen();
        viewer.save(*options.screenshot);
    } else {
        viewer.open();
    }
}

} // namespace isolux
