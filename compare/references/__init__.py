"""What is known without a solver: closed forms and quadratures, each with its equation and where it comes from.

line_contact : steady sliding of a cylinder on a standard linear solid
waves : elastic contact of one wave and of two crossed ones
full_contact : pressure and friction of a rough plane that touches everywhere
indentation : a body of revolution pressed into a viscoelastic solid and withdrawn
layer : a body of revolution pressed into an elastic layer on a rigid base
tangential : a contact pressed, then drawn along the surface against friction

Units are SI. Moduli are E* = E/(1 - nu^2) unless a solid is passed. The elastomer flows along +x, pressure is
positive, friction opposes the motion.
"""
