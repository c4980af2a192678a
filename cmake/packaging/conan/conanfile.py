# SPDX-License-Identifier: MIT
"""Conan 2 recipe: the headers of Voussoir, without the target voussoir::compiled."""

import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy
from conan.tools.layout import basic_layout

required_conan_version = ">=2.0"


class VoussoirConan(ConanFile):
    name = "voussoir"
    version = "0.1.0"
    description = (
        "Distinct element analysis of jointed rock around tunnels, and the design of their support"
    )
    license = "MIT"
    topics = ("geotechnics", "distinct-element-method", "tunnel", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..", "..")
        for pattern in ("LICENSE", "include/*.hpp"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def layout(self):
        basic_layout(self)

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)

    def package_id(self):
        self.info.clear()

    def validate(self):
        check_min_cppstd(self, 20)

    def package(self):
        source, package = self.source_folder, self.package_folder
        copy(self, "LICENSE", src=source, dst=os.path.join(package, "licenses"))
        copy(self, "*.hpp", src=os.path.join(source, "include"), dst=os.path.join(package, "include"))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "voussoir")
        self.cpp_info.set_property("cmake_target_name", "voussoir::voussoir")
        self.cpp_info.set_property("pkg_config_name", "voussoir")
        if self.settings.get_safe("os") in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread"]
