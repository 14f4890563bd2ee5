"""Predictions: the answer does not stand above the question, in the text, the headings or the outputs."""

import json
import re
from pathlib import Path

import pytest

from imgproc_course.classroom.authoring.execute import output_texts
from imgproc_course.classroom.authoring.masters import find_lessons
import nbformat
