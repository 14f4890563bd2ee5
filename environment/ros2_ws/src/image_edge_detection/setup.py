from pathlib import Path

from setuptools import find_packages, setup

package_name = "image_edge_detection"

setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        # The marker by which ROS finds the package, and the files for `ros2 launch` in its share folder.
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (f"share/{package_name}/launch", sorted(map(str, Path("launch").glob("*.launch.py")))),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="The course's authors",
    maintainer_email="course@example.org",
    description="Detects edges in the camera's images: a ROS 2 node of the course on image processing.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        # Creates the executable for `ros2 run image_edge_detection image_edge_detection`.
        "console_scripts": [f"{package_name} = {package_name}.{package_name}:main"],
    },
)
