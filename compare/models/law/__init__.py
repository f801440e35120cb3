"""Friction of rough bodies in closed form: what all waves lose in full contact, and the share that partial contact
leaves of it.

bands : a spectrum as waves, and what these do in full contact
smooth : the smooth contact that roughness is added to
nominal : that contact with its roughness as a soft layer
share : the share of friction that partial contact leaves, as measured on rough planes
friction_law : the law of friction, a model
persson : Persson's theory, a model
"""
