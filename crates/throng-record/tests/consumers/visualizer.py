"""jupedsim-visualizer opens what throng wrote: python visualizer.py RUN.sqlite PICTURE.png

Needs jupedsim, PySide6-Essentials and vtk, a display, and the folder python_modules/jupedsim_visualizer of JuPedSim's sources in
PYTHONPATH (it is in no package registry). The picture is of the middle frame.
"""
import sys
import traceback

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox

run, picture = sys.argv[1:3]
app = QApplication(sys.argv[:1])
from jupedsim_visualizer.main_window import MainWindow

window = MainWindow()
window.resize(1000, 760)
# what people choose in the dialog, and what they would be told
QFileDialog.getOpenFileName = staticmethod(lambda *_, **__: (run, ""))
QMessageBox.critical = staticmethod(lambda _, title, said: sys.exit(f"{title}: {said}"))
window._open_replay()
control = window.tabs.widget(0).control


def middle():
    control.slider.setValue(control.slider.maximum() // 2)
    QTimer.singleShot(2000, keep)


def keep():
    print(f"{control.slider.maximum() + 1} frames, {control.replay_time.text()} in the middle")
    app.primaryScreen().grabWindow(0).save(picture)
    app.quit()


# a slot that fails is only told of
sys.excepthook = lambda *error: (traceback.print_exception(*error), app.exit(1))
QTimer.singleShot(2000, middle)
sys.exit(app.exec())
