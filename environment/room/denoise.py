"""Intel's Open Image Denoise, from the wheel of bpy: Cycles does not denoise what it bakes."""

import ctypes
from pathlib import Path

import numpy as np

LIBRARIES = Path(np.__file__).parents[1] / "bpy" / "lib"
P, CPU, FLOAT3 = ctypes.c_void_p, 1, 3


def load_library():
    for path in sorted(LIBRARIES.glob("libtbb*")):
        ctypes.CDLL(str(path), ctypes.RTLD_GLOBAL)
    library = ctypes.CDLL(str(LIBRARIES / "libOpenImageDenoise.so.2"))
    size = ctypes.c_size_t
    for name, arguments, result in (
        ("NewDevice", [ctypes.c_int], P),
        ("CommitDevice", [P], None),
        ("NewFilter", [P, ctypes.c_char_p], P),
        ("CommitFilter", [P], None),
        ("ExecuteFilter", [P], None),
        ("SetSharedFilterImage", [P, ctypes.c_char_p, P, ctypes.c_int, *[size] * 5], None),
        ("SetFilterBool", [P, ctypes.c_char_p, ctypes.c_bool], None),
        ("GetDeviceError", [P, ctypes.POINTER(ctypes.c_char_p)], ctypes.c_int),
    ):
        function = getattr(library, "oidn" + name)
        function.argtypes, function.restype = arguments, result
    return library


def denoise(image):
    """A light map (H, W, 3) without its noise, float32."""
    library = load_library()
    device = library.oidnNewDevice(CPU)
    library.oidnCommitDevice(device)
    image = np.ascontiguousarray(image, np.float32)
    result = np.zeros_like(image)
    height, width = image.shape[:2]
    task = library.oidnNewFilter(device, b"RT")
    for name, array in ((b"color", image), (b"output", result)):
        library.oidnSetSharedFilterImage(task, name, array.ctypes.data, FLOAT3, width, height, 0, 0, 0)
    library.oidnSetFilterBool(task, b"hdr", True)
    library.oidnCommitFilter(task)
    library.oidnExecuteFilter(task)
    message = ctypes.c_char_p()
    if library.oidnGetDeviceError(device, ctypes.byref(message)):
        raise RuntimeError(f"Open Image Denoise: {message.value}")
    return result
