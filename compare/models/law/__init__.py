"""Friction of rough bodies in closed form: what all waves lose in full contact, and the share that partial contact
leaves of it.

bands : a spectrum as waves, and what these do in full contact
smooth : the smooth contact that roughness is added to
persson : Persson's theory, a model
"""
